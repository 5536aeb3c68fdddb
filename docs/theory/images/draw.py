"""Draws the figures of docs/theory from what Hammerbeam exports, and checks the formulas on the way.

    HAMMERBEAM=hammerbeam python docs/theory/images/draw.py

Needs Python 3.10, NumPy and Matplotlib. The studies are those of the folder `studies`; results go to a
temporary folder. About a minute on one core.
"""

import csv
import json
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

HERE = Path(__file__).resolve().parent
STUDIES = HERE.parents[2] / "studies"
HAMMERBEAM = os.environ.get("HAMMERBEAM", "hammerbeam")
BLUE, RED, GREEN, GREY = "#0b5394", "#c0392b", "#2e7d32", "#777777"

plt.rcParams.update(
    {
        "font.family": "sans-serif",
        "font.size": 8,
        "axes.linewidth": 0.6,
        "lines.linewidth": 1.2,
        "legend.frameon": False,
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


def hammerbeam(*arguments):
    command = [HAMMERBEAM, *map(str, arguments)]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def table(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def column(rows, name):
    return np.array([float(row[name]) for row in rows])


def save(figure, name):
    figure.savefig(
        HERE / f"{name}.svg", metadata={"Date": None, "Creator": None}, bbox_inches="tight", pad_inches=0.04
    )
    plt.close(figure)


class Beam:
    """The modal form of studies/beam-with-stop.toml, driven at one frequency; equations (F1) to (F6)."""

    DAMPING_RATIO = 0.015
    AMPLITUDE = 0.5015e-3
    # Participation of the modes in the motion of the table [kg^1/2]; held by the test
    # `modal_coordinates_of_the_reduced_beam_agree_to_every_digit`.
    PARTICIPATION = np.array([0.326581, -0.160943, 0.092436, -0.064797, 0.065038, -0.029896])

    def __init__(self, frequency_hz):
        modes = json.loads(hammerbeam("modes", STUDIES / "beam-with-stop.toml", "--json"))
        self.rate = 2 * np.pi * np.array(modes["reduced_hz"])
        self.shape = np.array(modes["mass_normalised_shapes"]["contact"])
        self.k, self.c = self.rate**2, 2 * self.DAMPING_RATIO * self.rate
        self.circular = 2 * np.pi * frequency_hz
        # (F4): b_i = gamma_i W^2 U, since q'' + ... = -gamma u''.
        self.steady = (
            self.PARTICIPATION
            * self.circular**2
            * self.AMPLITUDE
            / (self.k - self.circular**2 + 1j * self.circular * self.c)
        )

    def particular(self, time):
        """Displacements and velocities of the modes, (F4)."""
        turned = self.steady * np.exp(1j * self.circular * time)
        return turned.real, (1j * self.circular * turned).real

    def free(self, state, time):
        """The homogeneous part after `time`, (F2) and (F3)."""
        p, s = state
        half = self.c / 2
        root = np.sqrt(self.k - half**2)
        decay = np.exp(-half * time)
        cosine, sine = decay * np.cos(root * time), decay * np.sin(root * time) / root
        return (cosine + half * sine) * p + sine * s, -self.k * sine * p + (cosine - half * sine) * s

    def jet(self, state, time):
        """r, r', r'', r''' of the contact against the table, upwards, at `time` in flight, (F5)."""
        p, s = self.free(state, time)
        rows = [self.shape * p, self.shape * s, self.shape * (-self.k * p - self.c * s)]
        rows.append(self.shape * (self.c * self.k * p + (self.c**2 - self.k) * s))
        turned = self.steady * np.exp(1j * self.circular * time)
        steady = [(self.shape @ ((1j * self.circular) ** m * turned)).real for m in range(4)]
        return np.array([row.sum() for row in rows]) + steady

    def bounds(self, state):
        """Bounds on |r''| and |r'''| for all later times, (F6)."""
        energy = np.sqrt(self.k * state[0] ** 2 + state[1] ** 2)
        second = np.abs(self.shape) * np.hypot(np.sqrt(self.k), self.c)
        third = np.abs(self.shape) * np.hypot(self.c * np.sqrt(self.k), self.c**2 - self.k)
        drive = abs(self.shape @ self.steady)
        return drive * self.circular**2 + second @ energy, drive * self.circular**3 + third @ energy


def settled(folder, frequency_hz, samples):
    """Samples, contacts and the state at phase 0 of the motion that settles at a frequency."""
    hammerbeam(
        "simulate",
        STUDIES / "beam-with-stop.toml",
        "--frequency",
        frequency_hz,
        "--periods",
        1,
        "--transient-periods",
        300,
        "--samples-per-period",
        samples,
        "--out",
        folder,
    )
    first = table(folder / "stroboscopic.csv")[0]
    state = np.array([[float(first[f"{part}{i}"]) for i in range(1, 7)] for part in "qv"])
    return table(folder / "samples.csv"), table(folder / "contacts.csv"), state


def draw_flight(folder):
    frequency = 36.2
    samples, contacts, modal = settled(folder / "flight", frequency, 2000)
    beam = Beam(frequency)
    state = modal - np.array(beam.particular(0.0))
    time, relative = column(samples, "time_s"), -column(samples, "stop_1_relative_displacement_m")
    start = float(contacts[0]["begin_s"])
    end = float(contacts[0]["end_s"])
    in_flight = time < start
    exact = np.array([beam.jet(state, t)[0] for t in time[in_flight]])
    difference = np.abs(exact - relative[in_flight]).max()
    print(f"flight: closed form against Hammerbeam {difference:.1e} m")
    assert difference < 2e-9, "the participations have six digits"
    figure, (left, right) = plt.subplots(1, 2, figsize=(6.6, 2.5), width_ratios=[2.2, 1])
    left.axhspan(-0.6, 0, color="#eeeeee", lw=0)
    left.plot(time * 1e3, relative * 1e3, color=BLUE, label="Hammerbeam")
    left.plot(
        time[in_flight][::60] * 1e3,
        exact[::60] * 1e3,
        "o",
        ms=3.5,
        mfc="none",
        color=RED,
        mew=0.8,
        label="(F2) to (F5)",
    )
    left.axvline(start * 1e3, color=GREY, lw=0.6, ls=":")
    left.text(start * 1e3 + 0.4, 4.2, "contact,\n0.14 ms", ha="left", va="center", color=GREY)
    left.text(0.5, -0.3, "stop", color=GREY, va="center")
    left.set(
        xlabel="Time (ms)", ylabel="Relative displacement (mm)", xlim=(0, time[-1] * 1e3), ylim=(-0.6, 7.6)
    )
    left.legend(loc="upper right")
    fine, _, _ = settled(folder / "fine", frequency, 60000)
    within = [row for row in fine if start - 2e-5 < float(row["time_s"]) < end + 2e-5]
    right.plot((column(within, "time_s") - start) * 1e6, -column(within, "stop_1_force_n"), color=BLUE)
    right.set(
        xlabel="Time from the touch (µs)",
        ylabel="Contact force (N)",
        ylim=(0, None),
        xlim=(-20, (end - start) * 1e6 + 20),
    )
    figure.tight_layout()
    save(figure, "flight")
    draw_clearance(beam, state, start)
    draw_nodes(within, start, end)


def safe_steps(value, slope, curvature, second, third):
    """(C2) and (C3)."""
    square = (slope + np.sqrt(slope**2 + 2 * second * value)) / second
    roots = np.roots([-third / 6, curvature / 2, slope, value])
    cubic = min(root.real for root in roots if abs(root.imag) < 1e-9 * abs(root) and root.real > 0)
    return square, cubic


def draw_clearance(beam, state, start):
    """The certified search over the flight, by (C2) and (C3) alone (without the convex stretches)."""
    looks, time = [], 0.0
    while True:
        value, slope, curvature, _ = beam.jet(state, time)
        if value < 1e-15:
            break
        carried = beam.free(state, time)
        second, third = beam.bounds(carried)
        step = max(safe_steps(value, slope, curvature, second, third))
        looks.append((time, value, slope, curvature, third, step))
        time += step
        if step < 1e-13:
            break
    print(f"clearance: {len(looks)} looks, contact {time - start:.1e} s from Hammerbeam's")
    assert abs(time - start) < 1e-8
    figure, (left, right) = plt.subplots(1, 2, figsize=(6.6, 2.5))
    times = np.linspace(0, start, 800)
    clearance = np.array([beam.jet(state, t)[0] for t in times])
    left.plot(times * 1e3, clearance * 1e3, color=BLUE, label="clearance d")
    for i, (t, value, slope, curvature, third, step) in enumerate(looks):
        s = np.linspace(0, step, 60)
        left.plot(
            (t + s) * 1e3,
            (value + slope * s + curvature * s**2 / 2 - third * s**3 / 6) * 1e3,
            color=RED,
            lw=0.8,
            label="lower bound (C3)" if i == 0 else None,
        )
    left.plot(
        [look[0] * 1e3 for look in looks],
        [look[1] * 1e3 for look in looks],
        "o",
        ms=2.5,
        color=RED,
        label="look",
    )
    left.set(xlabel="Time (ms)", ylabel="Clearance (mm)", xlim=(0, start * 1e3 * 1.02), ylim=(0, 7.2))
    left.legend(loc="upper right", ncols=3, columnspacing=0.8, handlelength=1.2)
    remaining = np.array([start - look[0] for look in looks])
    right.semilogy(
        np.arange(1, len(looks) + 1),
        np.maximum(np.abs(remaining), 1e-12) * 1e3,
        "o-",
        ms=2.5,
        lw=0.8,
        color=RED,
    )
    right.set(xlabel="Look", ylabel="Time left to the contact (ms)")
    figure.tight_layout()
    save(figure, "clearance")


def gauss(count, graded):
    """Nodes in s of Gauss' rule for the weight c'(s): 1, or 2 s."""
    points, weights = np.polynomial.legendre.leggauss(80)
    s = (points + 1) / 2
    weights = weights / 2 * (2 * s if graded else 1)
    a, b, previous, current = [], [], np.zeros_like(s), np.ones_like(s) / np.sqrt(weights.sum())
    for _ in range(count):
        a.append((weights * s * current**2).sum())
        following = (s - a[-1]) * current - (b[-1] if b else 0) * previous
        b.append(np.sqrt((weights * following**2).sum()))
        previous, current = current, following / b[-1]
    return np.sort(np.linalg.eigvalsh(np.diag(a) + np.diag(b[:-1], 1) + np.diag(b[:-1], -1)))


def lagrange(nodes, s):
    """Lagrange polynomials [node, place]."""
    values = np.ones((len(nodes), len(np.atleast_1d(s))))
    for j, node in enumerate(nodes):
        for other in np.delete(nodes, j):
            values[j] *= (s - other) / (node - other)
    return values


def collocated(count, graded, length):
    """Unit mass and speed enter a Hertz contact p'' = -p^1.5; the state after `length`, (S2), (S3)."""
    nodes = gauss(count, graded)
    points, weights = np.polynomial.legendre.leggauss(60)
    points, weights = (points + 1) / 2, weights / 2
    clock = (lambda s: length * s**2) if graded else (lambda s: length * s)
    slope = (lambda s: 2 * length * s) if graded else (lambda s: length + 0 * s)

    def integrals(s_end):
        s = points * s_end
        measure = weights * s_end * slope(s)
        polynomials = lagrange(nodes, s)
        return polynomials @ (measure * (clock(s_end) - clock(s))), polynomials @ measure

    response = np.array([integrals(s)[0] for s in nodes])
    end_displacement, end_velocity = integrals(1.0)
    times = clock(nodes)
    p = times.copy()
    for _ in range(40):
        force = -np.maximum(p, 0) ** 1.5
        residual = times + response @ force - p
        step = np.linalg.solve(np.eye(count) - response * (-1.5 * np.sqrt(np.maximum(p, 0))), residual)
        p = p + step
        if np.abs(step).max() < 1e-15:
            break
    force = -np.maximum(p, 0) ** 1.5
    return length + end_displacement @ force, 1 + end_velocity @ force


def draw_nodes(within, start, end):
    length = 1.5  # about half of this contact, which lasts 3.2
    exact = collocated(26, True, length)
    counts = np.arange(3, 15)
    error = {
        graded: [np.hypot(*(np.array(collocated(n, graded, length)) - exact)) for n in counts]
        for graded in (True, False)
    }
    print(f"collocation: twelve nodes {error[True][9]:.1e} graded, {error[False][9]:.1e} not")
    # First integral: v^2/2 + (2/5) p^2.5 = 1/2.
    assert abs(exact[1] ** 2 / 2 + 0.4 * exact[0] ** 2.5 - 0.5) < 1e-14
    figure, (left, right) = plt.subplots(1, 2, figsize=(6.6, 2.5))
    time, force = (column(within, "time_s") - start) * 1e6, -column(within, "stop_1_force_n")
    left.plot(time, force, color=BLUE)
    duration = (end - start) * 1e6
    s = gauss(12, True)
    middle = duration / 2
    for nodes, colour in ((middle * s**2, RED), (duration - middle * s**2, GREEN)):
        left.plot(nodes, np.interp(nodes, time, force), "o", ms=3, color=colour)
    left.plot([], [], "o", ms=3, color=RED, label="step graded at the touch")
    left.plot([], [], "o", ms=3, color=GREEN, label="graded at the release")
    left.set(
        xlabel="Time from the touch (µs)",
        ylabel="Contact force (N)",
        ylim=(0, 1600),
        xlim=(-5, duration + 5),
    )
    left.legend(loc="upper center", ncols=1)
    right.semilogy(counts, error[False], "s-", ms=3, lw=0.8, color=GREY, label="time as it is, $t = hs$")
    right.semilogy(
        counts, np.maximum(error[True], 1e-16), "o-", ms=3, lw=0.8, color=RED, label="graded, $t = hs^2$"
    )
    right.axvline(12, color=GREY, lw=0.6, ls=":")
    right.set(xlabel="Nodes in the step", ylabel="Error at the end of the step")
    right.legend(loc="upper right")
    figure.tight_layout()
    save(figure, "collocation")


def duffing_flow(z, phases, frequency):
    """Duffing's oscillator of studies/duffing.toml by Runge and Kutta's method; the states on the way."""
    omega = 2 * np.pi * frequency
    rate = lambda t, z: np.array([z[1], -0.1 * z[1] - z[0] - z[0] ** 3 + 0.3 * np.cos(omega * t)])
    times = np.linspace(phases[0], phases[1], 4001) / frequency
    states, step = [np.array(z)], times[1] - times[0]
    for t in times[:-1]:
        z = states[-1]
        k1 = rate(t, z)
        k2 = rate(t + step / 2, z + step / 2 * k1)
        k3 = rate(t + step / 2, z + step / 2 * k2)
        k4 = rate(t + step, z + step * k3)
        states.append(z + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4))
    return np.array(states)[::10]


def draw_shooting(folder):
    hammerbeam("run", STUDIES / "duffing.toml", "--out", folder / "duffing", "--jobs", 1)
    hammerbeam("export", folder / "duffing", "--format", "csv", "--states")
    rows, branch = table(folder / "duffing/export/states.csv"), table(
        folder / "duffing/export/branches.csv"
    )
    frequency = 0.25
    # The orbit of largest amplitude at this frequency.
    near = [i for i, row in enumerate(rows) if abs(float(row["frequency_hz"]) - frequency) < 4e-4]
    chosen = max(near, key=lambda i: float(branch[i]["max_abs_displacement_m"]))
    frequency = float(rows[chosen]["frequency_hz"])
    phase = float(rows[chosen]["phase_cycles"])
    first = np.array([float(v) for v in rows[chosen]["state"].split()])
    orbit = duffing_flow(first, (phase, phase + 1), frequency)
    assert np.abs(orbit[-1] - first).max() < 1e-8, "the exported orbit is periodic"
    figure, (left, right) = plt.subplots(1, 2, figsize=(6.6, 2.7), width_ratios=[1.15, 1])
    left.plot(orbit[:, 0], orbit[:, 1], color=GREY, lw=0.8, label="orbit")
    for k in range(4):
        node = orbit[100 * k] * np.array([1.13, 0.92]) + np.array([0.05, -0.05])
        arc = duffing_flow(node, (phase + k / 4, phase + (k + 1) / 4), frequency)
        left.plot(arc[:, 0], arc[:, 1], color=BLUE, label="segment" if k == 0 else None)
        left.plot(*node, "o", ms=4, color=BLUE, label="node $z_k$" if k == 0 else None)
        target = orbit[100 * ((k + 1) % 4)] * np.array([1.13, 0.92]) + np.array([0.05, -0.05])
        left.plot(
            *zip(arc[-1], target), color=RED, lw=1.2, ls="-", label="residual $R_k$" if k == 0 else None
        )
    left.set(xlabel="Displacement (m)", ylabel="Velocity (m/s)")
    left.legend(
        loc="upper center",
        ncols=4,
        fontsize=7,
        columnspacing=0.7,
        handlelength=1.2,
        bbox_to_anchor=(0.5, 1.17),
    )
    multipliers = [[complex(m.replace("i", "j")) for m in row["multipliers"].split()] for row in rows]
    real = np.array([[m.real for m in pair] for pair in multipliers])
    imaginary = np.array([[m.imag for m in pair] for pair in multipliers])
    turn = np.linspace(0, 2 * np.pi, 200)
    right.plot(np.cos(turn), np.sin(turn), color=GREY, lw=0.8)
    right.plot(real[::15].ravel(), imaginary[::15].ravel(), ".", ms=1.5, color=BLUE)
    right.annotate(
        "folds: multiplier +1",
        (1, 0),
        (0.45, 1.28),
        arrowprops={"arrowstyle": "-", "lw": 0.6, "color": RED},
        color=RED,
        fontsize=7,
    )
    right.plot(1, 0, "o", ms=4, mfc="none", color=RED)
    right.set(
        xlabel="Real part", ylabel="Imaginary part", xlim=(-1.4, 2.2), ylim=(-1.5, 1.5), aspect="equal"
    )
    # Liouville (P6): the product of the multipliers is exp(-c T).
    product = np.array([(pair[0] * pair[1]).real for pair in multipliers])
    expected = np.exp(-0.1 / np.array([float(row["frequency_hz"]) for row in rows]))
    assert np.abs(product / expected - 1).max() < 1e-8
    print(f"shooting: product of multipliers off by {np.abs(product / expected - 1).max():.1e}")
    figure.tight_layout()
    save(figure, "shooting")


def draw_orientation():
    """A fold that is sharper than the step, walked with the angle rule (O5) and with the determinant (O4)."""
    tip, width, bend = 0.02, 0.035, 0.5
    height = lambda z: z[1] + bend * z[0] ** 2
    residual = lambda z: z[0] ** 2 - (height(z) / width) ** 2 - tip**2
    gradient = lambda z: np.array(
        [2 * z[0] - 4 * bend * z[0] * height(z) / width**2, -2 * height(z) / width**2]
    )
    along = lambda z: np.array([gradient(z)[1], -gradient(z)[0]]) / np.linalg.norm(gradient(z))

    def path(a):
        parameter = -np.hypot(a, tip)
        return np.array([parameter, width * a - bend * parameter**2])

    def corrected(z, tangent, step):
        guess = z + step * tangent
        for _ in range(30):
            matrix = np.array([gradient(guess), tangent])
            if abs(np.linalg.det(matrix)) < 1e-9:
                return None
            correction = np.linalg.solve(matrix, [residual(guess), tangent @ (guess - z) - step])
            guess = guess - correction
            if np.abs(correction).max() < 1e-13:
                return guess if guess[0] < 0 and np.linalg.norm(guess - z) < 2 * step else None
        return None

    def walk(by_angle, count):
        z = path(-0.85)
        tangent = along(z) * np.sign(along(z)[0])
        sign = np.sign(np.linalg.det([gradient(z), tangent]))
        points = [z]
        while len(points) < count:
            step = 0.17
            while (following := corrected(z, tangent, step)) is None:
                step /= 2
            turned = along(following)
            if by_angle:
                turned = turned * np.sign(turned @ tangent)
            else:
                turned = turned * sign * np.sign(np.linalg.det([gradient(following), turned]))
            z, tangent = following, turned
            points.append(z)
        return np.array(points)

    figure, axes = plt.subplots(1, 2, figsize=(6.6, 2.6), sharey=True)
    samples = np.array([path(a) for a in np.linspace(-0.95, 0.95, 801)])
    for axis, by_angle in zip(axes, (True, False)):
        points = walk(by_angle, 14 if by_angle else 9)
        on_upper = np.array([height(z) for z in points]) > 0
        assert on_upper[-1] != by_angle, "the angle rule runs back, the determinant does not"
        axis.plot(samples[:, 0], samples[:, 1], color=GREY, lw=0.8)
        axis.plot(points[:, 0], points[:, 1], "o", ms=3, color=RED if by_angle else BLUE)
        for i, (x, y) in enumerate(points):
            if i and np.linalg.norm(points[i] - points[i - 1]) < 0.03:
                continue
            up = on_upper[i]
            axis.annotate(
                str(i + 1),
                (x, y),
                (-4 if up else 4, 5 if up else -10),
                textcoords="offset points",
                ha="center",
                fontsize=6.5,
            )
        axis.set(xlabel="Parameter", xlim=(-0.98, 0.06))
        axis.set_title("angle rule (O5)" if by_angle else "determinant rule (O4)", fontsize=8)
    axes[0].set(ylabel="Solution")
    figure.tight_layout()
    save(figure, "orientation")


def draw_grazing(folder):
    hammerbeam("run", STUDIES / "impact-oscillator.toml", "--out", folder / "impact", "--jobs", 1)
    hammerbeam("export", folder / "impact", "--format", "csv")
    rows = [row for row in table(folder / "impact/export/branches.csv") if row["branch"] == "1"]
    frequency = column(rows, "frequency_hz")
    speed, contacts = column(rows, "max_impact_velocity_m_s"), column(rows, "contacts")
    modulus = np.hypot(column(rows, "leading_multiplier_re"), column(rows, "leading_multiplier_im"))
    stable = np.array([row["stable"] == "true" for row in rows])
    # Closed form (G5) of the sum of the multipliers over the speed.
    damping, restitution, gap, force = 0.04, 0.8, 1.0, 0.4

    def largest(f, v):
        w, period = 2 * np.pi * f, 1 / f
        half, root = damping / 2, np.sqrt(1 - damping**2 / 4)
        decay = np.exp(-half * period)
        cosine, sine = decay * np.cos(root * period), decay * np.sin(root * period) / root
        a, b, k, d = cosine + half * sine, sine, -sine, cosine - half * sine
        x = (1 + restitution) * v / (k - (1 - d) * (1 - a) / b)
        slope = -x * (1 - a) / b - restitution * v
        before = (1 - w * w) * (gap - x) + damping * slope - damping * v - gap
        after = before + damping * (1 + restitution) * v
        total = -restitution * (a + d) + b * (after + restitution * before) / v
        product = restitution**2 * np.exp(-damping * period)
        return max(abs(r) for r in np.roots([1, -total, product]))

    one = (contacts == 1) & (speed > 1e-4)
    expected = np.array([largest(f, v) for f, v in zip(frequency[one], speed[one])])
    away = speed[one] > 1e-2
    off = np.abs(modulus[one] / expected - 1)[away]
    print(
        f"grazing: {one.sum()} orbits, multiplier off by {np.median(off):.1e} (median), {off.max():.1e} at most"
    )
    assert np.median(off) < 1e-8 and off.max() < 1e-3
    figure, (left, right) = plt.subplots(1, 2, figsize=(6.6, 2.6))
    starts = np.flatnonzero(np.diff(stable.astype(int))) + 1
    for part in np.split(np.arange(len(rows)), starts):
        part = np.append(part, part[-1] + 1) if part[-1] + 1 < len(rows) else part
        left.plot(
            frequency[part],
            speed[part],
            color=BLUE if stable[part[0]] else RED,
            ls="-" if stable[part[0]] else "--",
        )
    for f, name, offset in (
        (0.12340454, "grazing", (-1, 7)),
        (0.18812598, "grazing", (14, 6)),
        (0.15754761, "flip", (-8, 6)),
        (0.25672674, "fold", (5, -3)),
    ):
        i = np.argmin(np.abs(frequency - f))
        left.plot(frequency[i], speed[i], "o", ms=3.5, mfc="white", color="black", mew=0.8)
        left.annotate(
            name,
            (frequency[i], speed[i]),
            offset,
            textcoords="offset points",
            fontsize=7,
            ha="right" if offset[0] < 0 else "left",
        )
    left.plot([], [], color=BLUE, label="stable")
    left.plot([], [], color=RED, ls="--", label="unstable")
    left.set(xlabel="Excitation frequency (Hz)", ylabel="Impact speed (m/s)", xlim=(0.1, 0.28))
    left.legend(loc="upper left")
    first = one & (frequency < 0.17) & (np.arange(len(rows)) < 1500)
    second = one & (frequency < 0.2) & ~first & ~stable
    order = np.argsort(speed[first])
    right.loglog(
        speed[first][order], modulus[first][order], ".", ms=2.5, color=BLUE, label="rows, lower grazing"
    )
    order = np.argsort(speed[second])
    right.loglog(
        speed[second][order], modulus[second][order], ".", ms=2.5, color=GREEN, label="rows, upper grazing"
    )
    speeds = np.array([1e-4, 1e-2])
    at = np.argmin(speed[first])
    right.loglog(
        speeds, modulus[first][at] * speed[first][at] / speeds, color=GREY, lw=0.8, label="slope −1"
    )
    right.axhline(1, color="black", lw=0.5)
    right.set(xlabel="Impact speed (m/s)", ylabel="Largest multiplier, modulus")
    right.legend(loc="upper right")
    figure.tight_layout()
    save(figure, "grazing")


def draw_exponents(folder):
    hammerbeam(
        "lyapunov",
        STUDIES / "ueda.toml",
        "--frequency",
        1 / (2 * np.pi),
        "--periods",
        20000,
        "--transient-periods",
        200,
        "--out",
        folder / "ueda",
    )
    hammerbeam("figure", folder / "ueda", "--kind", "exponents", "--jobs", 1, "--format", "svg")
    for kind in ("convergence", "section"):
        shutil.copy(folder / f"ueda/{kind}-1.svg", HERE / f"exponents-{kind}.svg")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        draw_flight(folder)
        draw_shooting(folder)
        draw_orientation()
        draw_grazing(folder)
        draw_exponents(folder)
