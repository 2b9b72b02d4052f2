"""The x-sweep of the Godunov scheme: wave-propagation form with limited second-order corrections.

After LeVeque (2002), "Finite Volume Methods for Hyperbolic Problems", chapters 6 and 15. Loops run over
flat arrays, see :mod:`solver.schemes.godunov.layout`; flow is subcritical, λ₋ < 0 < λ₊.
"""

import math

from solver.schemes.godunov.layout import (
    LAX_WENDROFF,
    MINMOD,
    SUPERBEE,
    UPWIND,
    VAN_LEER,
    Fields,
    Workspace,
)
from solver.schemes.vectorisation import exact_kernel, exact_part_of_kernel

# θ compares waves W = a(1, λ) by W·W', whose two entries have different units: aa'(c² + λλ') with c the unit
# of speed. The thesis computes in centimetres, and its digits depend on it.
UNIT_SPEED_SQUARED = 0.01**2  # m²/s²
NO_WAVE = 1e-140  # keeps 0/0 out of θ where there is no wave; squares of strengths are far larger


@exact_kernel
def decompose(fields: Fields, work: Workspace, begin: int, end: int, width: int, stiffening: float) -> None:
    """Split the jumps over the interfaces at flat places ``begin`` to ``end`` into waves.

    λ± = α̂û ± sqrt(R̂β̂/(2ρA₀) + û²α̂(α̂−1)) with û, R̂ of Roe's form, means of β and γ (2.2.46 ff.),
    W¹ = a₁(1, λ₋), W² = a₂(1, λ₊); ``stiffening`` is 1/(2ρA₀).
    """
    n = end - begin
    A_l, A_r = fields.area[begin:end], fields.area[begin + width : end + width]
    Q_l, Q_r = fields.flow[begin:end], fields.flow[begin + width : end + width]
    root_l, root_r = fields.root[begin:end], fields.root[begin + width : end + width]
    inverse_l = fields.inverse_root[begin:end]
    inverse_r = fields.inverse_root[begin + width : end + width]
    gamma_l, gamma_r = fields.exponent[begin:end], fields.exponent[begin + width : end + width]
    beta_l, beta_r = fields.stiffness[begin:end], fields.stiffness[begin + width : end + width]
    slow_speed, fast_speed = work.slow_speed[begin:end], work.fast_speed[begin:end]
    slow_strength, fast_strength = work.slow_strength[begin:end], work.fast_strength[begin:end]
    fastest = fields.fastest[begin:end]
    for k in range(n):
        roots = root_l[k] + root_r[k]
        gammas = gamma_l[k] + gamma_r[k] + 2.0
        inverse = 1.0 / (roots * gammas)
        over_roots = inverse * gammas
        alpha_excess = 2.0 * inverse * roots  # α̂ − 1
        u = (Q_r[k] * inverse_r[k] + Q_l[k] * inverse_l[k]) * over_roots
        radius = (2.0 / 3.0) * (A_r[k] + root_l[k] * root_r[k] + A_l[k]) * over_roots
        drift = (1.0 + alpha_excess) * u
        elastic = radius * (0.5 * (beta_l[k] + beta_r[k])) * stiffening
        c = math.sqrt(elastic + drift * u * alpha_excess)
        half_over_c = 0.5 / c
        jump_A, jump_Q = A_r[k] - A_l[k], Q_r[k] - Q_l[k]
        slow_speed[k] = drift - c
        fast_speed[k] = drift + c
        slow_strength[k] = ((drift + c) * jump_A - jump_Q) * half_over_c
        fast_strength[k] = (jump_Q - (drift - c) * jump_A) * half_over_c
        fastest[k] = max(fastest[k], abs(drift) + c)


@exact_kernel
def decompose_end(
    fields: Fields, work: Workspace, on: int, cell: int, interface: int, n: int, stiffening: float
) -> None:
    """Waves at an end: linearised with the end's own state, jump 2(q₁ − q_b) or 2(q_b − q_n).

    Parameters
    ----------
    fields, work : Fields, Workspace
    on, cell, interface : int
        Flat places where the end's column, its neighbouring cell and its interface begin.
    n : int
        Entries of a column.
    stiffening : float
        1/(2ρA₀), m/kg.
    """
    sign = 2.0 if cell > on else -2.0
    for k in range(n):
        b, c, f = on + k, cell + k, interface + k
        u = fields.flow[b] * fields.inverse_root[b] * fields.inverse_root[b]
        alpha_excess = 1.0 / (fields.exponent[b] + 1.0)
        drift = (1.0 + alpha_excess) * u
        speed = math.sqrt(fields.root[b] * fields.stiffness[b] * stiffening + drift * u * alpha_excess)
        jump_A = sign * (fields.area[c] - fields.area[b])
        jump_Q = sign * (fields.flow[c] - fields.flow[b])
        slow, fast = drift - speed, drift + speed
        work.slow_speed[f], work.fast_speed[f] = slow, fast
        work.slow_strength[f] = (fast * jump_A - jump_Q) / (2.0 * speed)
        work.fast_strength[f] = (jump_Q - slow * jump_A) / (2.0 * speed)
        fields.fastest[f] = max(fields.fastest[f], abs(drift) + speed)


@exact_part_of_kernel
def limited(limiter: int, up: float, own: float) -> float:
    """φ(θ) with θ = up/own, ``own`` ≥ 0, written so that no wave gives 0."""
    if limiter == VAN_LEER:
        return (up + abs(up)) / (own + abs(up) + NO_WAVE)
    if limiter == LAX_WENDROFF:
        return 1.0
    if limiter == UPWIND:
        return 0.0
    theta = up / (own + NO_WAVE)
    if limiter == SUPERBEE:
        return max(0.0, max(min(1.0, 2.0 * theta), min(2.0, theta)))
    if limiter == MINMOD:
        return max(0.0, min(1.0, theta))
    return max(0.0, min(min(0.5 * (1.0 + theta), 2.0), 2.0 * theta))


@exact_kernel
def correct(work: Workspace, begin: int, end: int, width: int, courant: float, limiter: int) -> None:
    """Fluctuations with limited corrections of the inner interfaces from ``begin`` to ``end``.

    What the cell on the right loses, λ₊W² − F̃, and what the one on the left loses, λ₋W¹ + F̃, with
    F̃ = ½Σ|λ|(1 − |λ|Δt/Δx) φ(θ) W; ``courant`` is Δt/Δx.
    """
    n = end - begin
    slow, slow_up = work.slow_speed[begin:end], work.slow_speed[begin + width : end + width]
    fast, fast_up = work.fast_speed[begin:end], work.fast_speed[begin - width : end - width]
    a1, a1_up = work.slow_strength[begin:end], work.slow_strength[begin + width : end + width]
    a2, a2_up = work.fast_strength[begin:end], work.fast_strength[begin - width : end - width]
    left_A, left_Q = work.to_left_area[begin:end], work.to_left_flow[begin:end]
    right_A, right_Q = work.to_right_area[begin:end], work.to_right_flow[begin:end]
    for k in range(n):
        own1 = a1[k] * a1[k] * (UNIT_SPEED_SQUARED + slow[k] * slow[k])
        own2 = a2[k] * a2[k] * (UNIT_SPEED_SQUARED + fast[k] * fast[k])
        up1 = a1[k] * a1_up[k] * (UNIT_SPEED_SQUARED + slow[k] * slow_up[k])
        up2 = a2[k] * a2_up[k] * (UNIT_SPEED_SQUARED + fast[k] * fast_up[k])
        wave1, wave2 = slow[k] * a1[k], fast[k] * a2[k]
        corrected1 = -0.5 * wave1 * (1.0 + courant * slow[k]) * limited(limiter, up1, own1)
        corrected2 = 0.5 * wave2 * (1.0 - courant * fast[k]) * limited(limiter, up2, own2)
        flux_A = corrected1 + corrected2
        flux_Q = slow[k] * corrected1 + fast[k] * corrected2
        left_A[k] = wave1 + flux_A
        left_Q[k] = slow[k] * wave1 + flux_Q
        right_A[k] = wave2 - flux_A
        right_Q[k] = fast[k] * wave2 - flux_Q


@exact_kernel
def uncorrected(work: Workspace, begin: int, end: int) -> None:
    """Fluctuations of the end interfaces, where the upwind method is forced."""
    for k in range(begin, end):
        work.to_left_area[k] = work.slow_speed[k] * work.slow_strength[k]
        work.to_left_flow[k] = work.slow_speed[k] * work.to_left_area[k]
        work.to_right_area[k] = work.fast_speed[k] * work.fast_strength[k]
        work.to_right_flow[k] = work.fast_speed[k] * work.to_right_area[k]
