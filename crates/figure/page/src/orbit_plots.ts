// An orbit in pictures: over time, in the phase plane, and its spectrum.

import type { Meta, Solutions } from "./data";
import { element, panel } from "./dom";
import { digits } from "./format";
import { ends, LinePlot, type Line, type Plot } from "./line_plot";
import { supportsOf } from "./motion";
import type { Orbit } from "./orbit";
import type { Theme } from "./theme";
import { MEASURES } from "./units";

/** Ratio of the largest amplitude of a spectrum to the least that is drawn. */
const DEPTH = 1e5;
const TIME = "Time / excitation period";
const DASHES = [[], [6, 3], [2, 3], [8, 3, 2, 3]];

/** Instants and values, of which the instants have the first one again behind the last. */
type Series = [Float64Array, Float64Array];

export class OrbitPlots {
    readonly root: HTMLElement;
    private readonly displacement: LinePlot;
    private readonly acceleration: LinePlot;
    private readonly force: LinePlot;
    private readonly impulse: LinePlot;
    private readonly impulses = element("p", { class: "note" });
    private readonly forcePanel: HTMLElement;
    private readonly impulsePanel: HTMLElement;
    private readonly jumps = element("p", { class: "note" }, [
        "Dotted: the velocity jumps at an impact on a rigid stop.",
    ]);
    private readonly phase: LinePlot;
    private readonly spectrum: LinePlot;
    private readonly support = element("p", { class: "note" }, ["Dashed: the support."]);
    private readonly elements = element("p", { class: "note" });
    private readonly harmonics = element("p", { class: "note" });
    private orbit: Orbit | null = null;

    constructor(
        private readonly meta: Meta,
        private readonly solutions: Solutions,
        private readonly theme: Theme,
    ) {
        [this.displacement, this.acceleration] = [new LinePlot(theme, 210), new LinePlot(theme, 210)];
        [this.force, this.impulse] = [new LinePlot(theme, 210), new LinePlot(theme, 210)];
        [this.phase, this.spectrum] = [
            new LinePlot(theme, 300, "place"),
            new LinePlot(theme, 300, "nothing"),
        ];
        this.forcePanel = panel("Forces of the local elements", "force", [this.force.host, this.elements]);
        this.impulsePanel = panel("Impulses of impacts on rigid stops", "impulse", [
            this.impulse.host,
            this.impulses,
        ]);
        this.root = element("div", { class: "plots" }, [
            panel("Displacement", "displacement", [this.displacement.host, this.support]),
            panel("Acceleration", "acceleration", [this.acceleration.host]),
            this.forcePanel,
            this.impulsePanel,
            panel("Phase portrait", "phase", [
                this.phase.host,
                element("p", { class: "note" }, ["Circles: phase 0 of each excitation period."]),
                this.jumps,
            ]),
            panel("Spectrum of the acceleration", "spectrum", [
                this.spectrum.host,
                element("p", { class: "note" }, [
                    "Lines from bottom to top: eigenfrequencies of the structure without its local elements.",
                ]),
                this.harmonics,
            ]),
        ]);
        theme.listen(() => {
            if (this.orbit !== null) {
                this.show(this.orbit);
            }
        });
    }

    show(orbit: Orbit): void {
        this.orbit = orbit;
        const first = this.theme.period(1);
        const over = (
            yLabel: string,
            series: Series[],
            factor: number,
            lines: (k: number) => Pick<Line, "colour" | "dash">,
        ): Plot => {
            const y = series.map(([, values]) => closed(values.map((value) => factor * value)));
            const x = series.map(([time]) => time);
            return {
                xLabel: TIME,
                yLabel,
                range: { x: [0, orbit.period], y: ends(y), logY: false },
                lines: y.map((values, k) => ({ x: x[k] ?? [], y: values, ...lines(k) })),
            };
        };
        /** Values at equal steps, or in the middle of each half of them. */
        const timed = (values: Float64Array, shift = 0): Series => [
            closed(
                values.map((_, k) => ((k + shift) * orbit.period) / values.length),
                orbit.period + (shift * orbit.period) / values.length,
            ),
            values,
        ];
        const isMoved = orbit.support.some((value) => value !== 0);
        this.support.hidden = !isMoved;
        const moved = this.meta.structure?.supports ?? [];
        this.support.textContent =
            moved.length > 1
                ? `Dashed, in their order: supports ${moved.join("; ")}.`
                : "Dashed: the support.";
        const [times, values] = orbit.course;
        const course: Series = [times, values.subarray(0, -1)];
        const supports = isMoved ? supportsOf(orbit, Math.max(1, moved.length)) : [];
        const moving = [course, ...supports.map((support) => timed(repeated(support, orbit.period)))];
        this.displacement.show(
            over(`Displacement (${MEASURES.displacement.unit})`, moving, MEASURES.displacement.factor, (k) =>
                k === 0 ? { colour: first } : { colour: this.theme.period(k + 1), dash: [5, 3] },
            ),
        );
        this.acceleration.show(
            over(
                `Acceleration (${MEASURES.acceleration.unit})`,
                [timed(orbit.acceleration, 0.5)],
                MEASURES.acceleration.factor,
                () => ({ colour: first }),
            ),
        );
        this.force.show(
            over(
                `Local force (${MEASURES.force.unit})`,
                orbit.forces.map((force) => timed(force, 0.5)),
                MEASURES.force.factor,
                (k) => ({ colour: this.theme.period(k + 1), dash: DASHES[k % DASHES.length] ?? [] }),
            ),
        );
        // As in print: where all stops are rigid and none sticks there are no forces to draw.
        this.forcePanel.hidden =
            orbit.impulses.length > 0 && orbit.forces.every((force) => force.every((value) => value === 0));
        this.impulsePanel.hidden = this.jumps.hidden = orbit.impulses.length === 0;
        this.impulse.show(this.impulsePlot(orbit));
        this.impulses.textContent = impulsesInWords(orbit);
        const names = this.meta.structure?.stops.map((stop) => stop.name) ?? [];
        this.elements.textContent =
            orbit.forces.length === 0
                ? "This structure has no local elements."
                : orbit.forces.length > 1
                  ? `In their order: ${names.join(", ")}.`
                  : "";
        this.phase.show(this.phasePlot(orbit, first));
        this.spectrum.show(this.spectrumPlot(orbit, first));
    }

    /** Shows an instant, in excitation periods since phase 0. */
    point(instant: number): void {
        const orbit = this.orbit;
        if (orbit !== null) {
            [this.displacement, this.acceleration, this.force, this.impulse].forEach((plot) =>
                plot.point(instant),
            );
            const place = (instant / orbit.period) * orbit.displacement.length;
            this.phase.point(
                MEASURES.displacement.factor * between(orbit.displacement, place),
                between(orbit.velocity, place),
            );
        }
    }

    private impulsePlot({ impulses, period }: Orbit): Plot {
        const elements = [...new Set(impulses.map(({ element: struck }) => struck))].sort((a, b) => a - b);
        const lines = elements.map((struck) => {
            const own = impulses.filter((impulse) => impulse.element === struck);
            return {
                x: own.map(({ cycles }) => cycles),
                y: own.map(({ impulse }) => impulse),
                colour: this.theme.period(struck + 1),
            };
        });
        return {
            xLabel: TIME,
            yLabel: "Impulse (N s)",
            range: { x: [0, period], y: ends([[0], ...lines.map(({ y }) => y)]), logY: false },
            lines,
            circles: impulses.map(({ cycles, impulse }) => [cycles, impulse]),
            stems: 0,
        };
    }

    private phasePlot(orbit: Orbit, colour: string): Plot {
        const [x, y] = [
            closed(orbit.portrait[0].map((value) => MEASURES.displacement.factor * value)),
            closed(orbit.portrait[1]),
        ];
        const step = orbit.displacement.length / orbit.period;
        const circles = Array.from({ length: orbit.period }, (_, k): [number, number] => [
            MEASURES.displacement.factor * (orbit.displacement[k * step] ?? NaN),
            orbit.velocity[k * step] ?? NaN,
        ]);
        const jumps = orbit.impulses.map(({ displacement, velocity }) => ({
            x: [MEASURES.displacement.factor * displacement, MEASURES.displacement.factor * displacement],
            y: [...velocity],
            colour: this.theme.look.pale,
            dash: [2, 3],
        }));
        return {
            xLabel: `Displacement (${MEASURES.displacement.unit})`,
            yLabel: "Velocity (m/s)",
            range: { x: ends([x]), y: ends([y]), logY: false },
            lines: [{ x, y, colour }, ...jumps],
            circles,
        };
    }

    private spectrumPlot(orbit: Orbit, colour: string): Plot {
        const y = orbit.spectrum.map((level) => 10 ** level);
        const { factor, unit } = MEASURES.frequency;
        const base = (factor * (this.solutions.frequency[orbit.solution] ?? 1)) / orbit.period;
        const x = y.map((_, k) => (k + 1) * base);
        const eigenfrequencies = (this.meta.structure?.eigenfrequencies ?? []).map(
            (frequency) => factor * frequency,
        );
        const largest = y.reduce((most, value) => Math.max(most, value), 0);
        // As in print.
        const highest = 1.2 * Math.max(10 * base * orbit.period, ...eigenfrequencies);
        const top = largest > 0 ? 2 * largest : 1;
        const last = x.length * base;
        this.harmonics.hidden = last + base > highest;
        this.harmonics.textContent =
            `The page carries ${x.length} harmonics of this orbit, up to ${digits(last, 4)} ${unit}; ` +
            "what lies above is not known here.";
        return {
            xLabel: `Frequency (${unit})`,
            yLabel: "Amplitude (m/s²)",
            range: { x: [0, highest], y: [top / DEPTH / 2, top], logY: true },
            lines: [{ x, y, colour }],
            verticals: eigenfrequencies,
            stems: top / DEPTH / 2,
        };
    }
}

/** A series so many times, one after the other. */
function repeated(values: Float64Array, times: number): Float64Array {
    const whole = new Float64Array(times * values.length);
    for (let k = 0; k < times; k++) {
        whole.set(values, k * values.length);
    }
    return whole;
}

/** Impulses up to which each is said. */
const FEW = 4;

/** How many impulses there are, and how large: of a few each, of more their sum and the largest. */
function impulsesInWords({ impulses }: Orbit): string {
    const sizes = impulses.map(({ impulse }) => Math.abs(impulse));
    if (sizes.length <= FEW) {
        const several = sizes.length === 1 ? "One impact" : `${sizes.length} impacts`;
        return `${several}: ${sizes.map((size) => digits(size, 4)).join(", ")} N s.`;
    }
    const sum = sizes.reduce((all, size) => all + size, 0);
    const largest = digits(Math.max(...sizes), 4);
    return `${sizes.length} impacts: together ${digits(sum, 4)} N s, the largest ${largest} N s.`;
}

/** With its first value behind its last one, or another one. */
function closed(values: Float64Array, last = values[0] ?? NaN): Float64Array {
    const whole = new Float64Array(values.length + 1);
    whole.set(values);
    whole[values.length] = last;
    return whole;
}

/** A value between two samples of a periodic series, on the line between them. */
function between(values: Float64Array, place: number): number {
    const before = Math.floor(place);
    const at = (k: number): number => values[((k % values.length) + values.length) % values.length] ?? NaN;
    return at(before) + (place - before) * (at(before + 1) - at(before));
}
