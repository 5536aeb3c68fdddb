"""Draws the figures of docs/reference/contact-laws.md from the formulas of that page.

    python docs/reference/images/draw.py

Needs Python 3.10, NumPy and Matplotlib. Nothing is integrated: the loops are the first integrals of a bounce.
"""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

HERE = Path(__file__).resolve().parent
BLUE, RED, GREEN, GREY, BROWN, PURPLE, BLACK = (
    "#0b5394",
    "#c0392b",
    "#2e7d32",
    "#777777",
    "#8a5a00",
    "#6a3d9a",
    "#222222",
)

plt.rcParams.update(
    {
        "font.family": "sans-serif",
        "font.size": 8,
        "axes.linewidth": 0.6,
        "lines.linewidth": 1.2,
        "legend.frameon": False,
        "legend.fontsize": 7,
        "xtick.major.width": 0.6,
        "ytick.major.width": 0.6,
        "xtick.direction": "in",
        "ytick.direction": "in",
        "svg.hashsalt": "hammerbeam",
        "figure.facecolor": "white",
        "savefig.facecolor": "white",
        "svg.fonttype": "path",
    }
)

# (L9) of the page.
FACTORS = {
    "Hunt-Crossley": lambda e: 1.5 * (1 - e),
    "Herbert-McWhannell": lambda e: 6 * (1 - e) / ((2 * e - 1) ** 2 + 3),
    "Lee-Wang": lambda e: 0.75 * (1 - e),
    "Lankarani-Nikravesh": lambda e: 0.75 * (1 - e * e),
    "Gonthier": lambda e: (1 - e * e) / e,
    "Flores": lambda e: 1.6 * (1 - e) / e,
    "Hu-Guo": lambda e: 1.5 * (1 - e) / e,
}
COLOURS = dict(zip(FACTORS, (BLUE, RED, GREEN, BROWN, PURPLE, BLACK, GREY)))
STYLES = dict(zip(FACTORS, ("-", "--", "-.", "-", "--", "-.", ":")))


def save(figure, name):
    figure.tight_layout()
    figure.savefig(
        HERE / f"{name}.svg", metadata={"Date": None, "Creator": None}, bbox_inches="tight", pad_inches=0.04
    )
    plt.close(figure)


def ratio_of_speeds(y):
    """e_out of `(1 + e) y = ln((1 + y)/(1 - e y))`, (L8), by bisection."""
    if y == 0:
        return 1.0
    low, high = 0.0, min(1.0, 1 / y)
    for _ in range(200):
        e = (low + high) / 2
        excess = (1 + e) * y - np.log1p(y) + np.log1p(-e * y) if e * y < 1 else -np.inf
        low, high = (e, high) if excess > 0 else (low, e)
    return (low + high) / 2


def loop(y):
    """Penetration and force of a bounce on a Hertz contact with the loss y; units: the bounce without loss.

    With u = p'/v: `p^2.5 = F(1) - F(u)`, `F(u) = 2 (u/y - ln(1 + y u)/y^2)`, so y = 0 has its largest p at 1.
    """
    u = np.linspace(1, -ratio_of_speeds(y), 600)
    integral = (lambda u: 2 * (u / y - np.log1p(y * u) / y**2)) if y > 1e-6 else (lambda u: u * u)
    p = np.maximum(integral(1) - integral(u), 0) ** 0.4
    return p, p**1.5 * (1 + y * u)


def damped_loop(ratio):
    """Penetration and force of a bounce on a spring with a damper, (L3); units: without the damper."""
    slowed = np.sqrt(1 - ratio**2)
    t = np.linspace(0, (np.pi - 2 * np.arcsin(ratio)) / slowed, 600)
    p = np.exp(-ratio * t) * np.sin(slowed * t) / slowed
    rate = np.exp(-ratio * t) * (np.cos(slowed * t) - ratio / slowed * np.sin(slowed * t))
    force = p + 2 * ratio * rate
    assert abs(force[-1]) < 1e-12, "the force ends where the pressure vanishes"
    assert abs(-rate[-1] - np.exp(-t[-1] * ratio)) < 1e-12, "restitution (L4)"
    return p, force


def check():
    """What comes out of the printed factors, as `crates/motion/tests/bounces.rs` has it."""
    table = {
        "Hunt-Crossley": (0.909016, 0.768000, 0.662962, 0.581288),
        "Herbert-McWhannell": (0.900893, 0.722683, 0.593624, 0.519967),
        "Lee-Wang": (0.952370, 0.869343, 0.799199, 0.738995),
        "Lankarani-Nikravesh": (0.913177, 0.795973, 0.725241, 0.684225),
        "Gonthier": (0.876435, 0.669581, 0.487741, 0.304225),
        "Flores": (0.893921, 0.683184, 0.470445, 0.256208),
        "Hu-Guo": (0.899900, 0.697297, 0.487741, 0.270658),
    }
    for name, row in table.items():
        for e, expected in zip((0.9, 0.7, 0.5, 0.3), row):
            assert abs(ratio_of_speeds(FACTORS[name](e)) - expected) < 1e-6, (name, e)


def draw_elastic():
    figure, (left, right) = plt.subplots(1, 2, figsize=(6.6, 2.5))
    r = np.linspace(-2, 2.2, 841)
    gap = 0.5
    beyond = np.maximum(r - gap, 0)
    left.plot(r, beyond, color=BLUE, label="linear (L2)")
    left.plot(r, beyond**1.5, color=RED, ls="--", label="Hertz (L5)")
    left.plot(
        r,
        np.where(r > gap, r - gap, np.where(r < -0.9, r + 0.9, 0)),
        color=GREEN,
        ls="-.",
        lw=1.8,
        alpha=0.7,
        label="two-sided (L11)",
    )
    left.axvline(gap, color=GREY, lw=0.5, ls=":")
    left.text(gap + 0.04, -1.05, "gap", color=GREY, fontsize=7)
    left.set(
        xlabel="Relative displacement r", ylabel="Force on the stop, −f", xlim=(-2, 2.2), ylim=(-1.2, 2.3)
    )
    left.legend(loc="upper left")
    right.plot(r, r, color=BLUE, label="power, n = 1")
    right.plot(r, r**2, color=RED, ls="--", label="n = 2")
    right.plot(r, r**3, color=GREEN, ls="-.", label="n = 3")
    right.plot(r, r**3 - r, color=BROWN, ls=":", label="n = 3, and n = 1 with k < 0: two wells")
    right.axhline(0, color=GREY, lw=0.4)
    right.set(xlabel="Relative displacement r", ylabel="−f", xlim=(-2, 2.2), ylim=(-4, 4))
    right.legend(loc="lower right", fontsize=6.5)
    save(figure, "contact-laws-elastic")


def draw_loops():
    figure, axes = plt.subplots(1, 3, figsize=(6.8, 2.5))
    for ratio, colour, style in ((0.0, GREY, ":"), (0.1, BLUE, "-"), (0.3, RED, "--"), (0.6, GREEN, "-.")):
        axes[0].plot(*damped_loop(ratio), color=colour, ls=style, label=f"ζ = {ratio:g}")
    axes[0].set_title("linear with damper (L3)", fontsize=8)
    for loss, colour, style in ((0.0, GREY, ":"), (0.1, BLUE, "-"), (0.3, RED, "--"), (1.0, GREEN, "-.")):
        axes[1].plot(*loop(1.5 * loss), color=colour, ls=style, label=f"a v = {loss:g}")
    axes[1].set_title("Hunt-Crossley (L7)", fontsize=8)
    for name in ("Lee-Wang", "Lankarani-Nikravesh", "Hunt-Crossley", "Flores"):
        axes[2].plot(*loop(FACTORS[name](0.6)), color=COLOURS[name], ls=STYLES[name], label=name)
    axes[2].set_title("with a restitution, e = 0.6 (L9)", fontsize=8)
    for axis in axes:
        axis.set(xlabel="Penetration", xlim=(0, 1.08), ylim=(0, None))
        axis.set_ylim(0, axis.get_ylim()[1] * 1.28)
        axis.legend(
            loc="upper left",
            ncols=1 if axis is axes[2] else 2,
            fontsize=6.2,
            handlelength=1.4,
            columnspacing=0.8,
        )
    axes[0].set(ylabel="Force")
    save(figure, "contact-laws-loops")


def draw_restitution():
    figure, axis = plt.subplots(figsize=(4.2, 2.9))
    e = np.linspace(0.005, 1, 200)
    axis.plot(e, e, color=GREY, lw=0.6)
    for name, factor in FACTORS.items():
        axis.plot(
            e, [ratio_of_speeds(factor(x)) for x in e], color=COLOURS[name], ls=STYLES[name], label=name
        )
    axis.set(
        xlabel="Coefficient of restitution e that goes in",
        ylabel="Ratio of speeds that comes out",
        xlim=(0, 1),
        ylim=(0, 1),
    )
    axis.legend(loc="lower right", fontsize=6.5)
    save(figure, "contact-laws-restitution")


if __name__ == "__main__":
    check()
    draw_elastic()
    draw_loops()
    draw_restitution()
