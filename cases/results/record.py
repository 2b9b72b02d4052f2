"""Records of JSON files: frozen, with the types they are declared with, no text taken for a number."""

from typing import Any

from pydantic import BaseModel, ConfigDict


class Record(BaseModel):
    """One object of a JSON file; keys that it does not declare are passed over."""

    model_config = ConfigDict(strict=True, frozen=True, allow_inf_nan=False, extra="ignore")

    def written(self) -> dict[str, Any]:
        """Content for a JSON file: what was stated, in the order of the declaration."""
        return self.model_dump(mode="json", exclude_unset=True)
