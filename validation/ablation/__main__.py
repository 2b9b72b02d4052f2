"""Parts of the coupled model: ``python -m validation.ablation CASE.yaml``."""

from cases.shell.command import run

if __name__ == "__main__":
    raise SystemExit(run("validation.ablation.command"))
