// The solutions as they are drawn: what both axes show in their units, on a linear or logarithmic scale, in
// pixels.

import type { Measured, Meta, Quantity, Solutions } from "./data";
import type { Range } from "./frame";
import type { State } from "./state";
import { isOutput, measureOf, outputOf, type Axis, type OutputAxis } from "./units";

/** The quantities that a vertical axis always has, where they are not zero throughout. */
const VERTICAL: readonly Axis[] = [
    "displacement",
    "acceleration",
    "force",
    "velocity",
    "multiplier",
    "energy",
    "contacts",
];

/** From values to pixels; `log` where the vertical axis is logarithmic. */
export interface Scales {
    left: number;
    top: number;
    width: number;
    height: number;
    perX: number;
    perY: number;
    lowX: number;
    lowY: number;
    log: boolean;
}

export interface Box {
    left: number;
    top: number;
    width: number;
    height: number;
}

export function scalesOf(range: Range, box: Box): Scales {
    const level = (value: number): number => (range.logY ? Math.log10(value) : value);
    const [lowX, highX] = range.x;
    const [lowY, highY] = [level(range.y[0]), level(range.y[1])];
    const { left, top, width, height } = box;
    return {
        left,
        top,
        width,
        height,
        perX: width / (highX - lowX),
        perY: height / (highY - lowY),
        lowX,
        lowY,
        log: range.logY,
    };
}

/** A column times a factor. A loop: with a function for each number it takes several times as long. */
function scaledBy(factor: number, column: ArrayLike<number>): Float64Array {
    const values = new Float64Array(column.length);
    for (let k = 0; k < values.length; k++) {
        values[k] = factor * (column[k] ?? NaN);
    }
    return values;
}

/** The magnitudes of complex numbers. */
function magnitudes(re: ArrayLike<number>, im: ArrayLike<number>): Float64Array {
    const values = new Float64Array(re.length);
    for (let k = 0; k < values.length; k++) {
        values[k] = Math.hypot(re[k] ?? NaN, im[k] ?? NaN);
    }
    return values;
}

export class Curves {
    private readonly kept = new Map<string, Float64Array>();

    constructor(
        private readonly meta: Meta,
        readonly solutions: Solutions,
    ) {}

    /** What an axis shows, in its unit. */
    values(axis: Axis, over: number): Float64Array {
        const { frequency, parameter, maxima, multiplierRe, multiplierIm, contacts, energy } = this.solutions;
        const { factor } = measureOf(this.meta, axis, over);
        const scaled = (column: ArrayLike<number>): Float64Array =>
            this.keep(`${axis} ${factor}`, () => scaledBy(factor, column));
        switch (axis) {
            case "parameter":
                return scaled(over === 0 ? frequency : parameter);
            case "multiplier":
                return this.keep(axis, () => magnitudes(multiplierRe, multiplierIm));
            case "contacts":
                return scaled(contacts);
            case "energy":
                return scaled(energy);
            default:
                return scaled(
                    isOutput(axis) ? (this.solutions.outputs[outputOf(axis)] ?? []) : maxima[axis],
                );
        }
    }

    /** The values of the horizontal axis. */
    across({ across, over }: State): Float64Array {
        return this.values(across, over);
    }

    /**
     * The values of the vertical axis; their logarithms to base 10 where it is logarithmic, NaN where they
     * have none.
     */
    levels({ quantity, log, over }: Pick<State, "quantity" | "log" | "over">): Float64Array {
        const values = this.values(quantity, over);
        return log
            ? this.keep(`log ${quantity} ${over}`, () =>
                  values.map((value) => (value > 0 ? Math.log10(value) : NaN)),
              )
            : values;
    }

    private keep(key: string, make: () => Float64Array): Float64Array {
        let found = this.kept.get(key);
        if (found === undefined) {
            found = make();
            this.kept.set(key, found);
        }
        return found;
    }

    /**
     * Vertical axes of which there is something, measured ones among them: without contacts over a time
     * there are no forces.
     */
    present(measured: readonly Measured[]): Axis[] {
        const always: readonly Axis[] = [
            "displacement",
            "acceleration",
            ...measured.map(({ quantity }): Quantity => quantity),
        ];
        const outputs = this.solutions.outputs.map((_, k): OutputAxis => `output-${k + 1}`);
        return [...VERTICAL, ...outputs].filter(
            (axis) =>
                always.includes(axis) ||
                this.values(axis, 0).some((value) => (isOutput(axis) ? value === value : value > 0)),
        );
    }

    /**
     * Least and largest value of a column among the branches that are drawn, and of others, widened a
     * little; null where nothing is.
     */
    extent(
        levels: Float64Array,
        hidden: ReadonlySet<number>,
        others: Iterable<number> = [],
    ): [number, number] | null {
        let [low, high] = [Infinity, -Infinity];
        const take = (level: number): void => {
            if (Number.isFinite(level)) {
                low = level < low ? level : low;
                high = level > high ? level : high;
            }
        };
        this.meta.branches.forEach(({ first, count }, place) => {
            for (let k = first; k < first + count && !hidden.has(place); k++) {
                take(levels[k] ?? NaN);
            }
        });
        for (const level of others) {
            take(level);
        }
        if (low > high) {
            return null;
        }
        const margin = 0.04 * (high - low || Math.abs(high) || 1);
        return [low - margin, high + margin];
    }

    /** The ends of the vertical axis that hold everything that is drawn. */
    upright(state: State, others: readonly number[] = []): [number, number] | null {
        const { log, hidden } = state;
        const extent = this.extent(this.levels(state), hidden, log ? others.map(Math.log10) : others);
        if (extent === null || log) {
            return extent === null ? null : [10 ** extent[0], 10 ** extent[1]];
        }
        const [low, high] = extent;
        const margin = (high - low) * (0.04 / 1.08);
        return [low + margin >= 0 && low + margin < 0.3 * high ? 0 : low, high];
    }

    /** Whether values are positive and span so much that a logarithmic axis is the better one. */
    spansMuch(quantity: Axis, over = 0): boolean {
        if (isOutput(quantity) && this.values(quantity, over).some((value) => value <= 0)) {
            return false;
        }
        const extent = this.extent(this.levels({ quantity, log: true, over }), new Set());
        return extent !== null && extent[1] - extent[0] > Math.log10(40);
    }

    /**
     * The solution nearest to a place in canvas pixels, within so many of them, and its distance; -1 for
     * none.
     */
    nearest(
        state: State,
        scales: Scales,
        place: [number, number],
        within: number,
    ): [solution: number, distance: number] {
        const [across, levels] = [this.across(state), this.levels(state)];
        const [x, y] = [
            (place[0] - scales.left) / scales.perX + scales.lowX,
            (scales.top + scales.height - place[1]) / scales.perY + scales.lowY,
        ];
        let [best, least] = [-1, within * within];
        this.meta.branches.forEach(({ first, count }, branch) => {
            for (let k = first; k < first + count && !state.hidden.has(branch); k++) {
                const right = ((across[k] ?? NaN) - x) * scales.perX;
                const up = ((levels[k] ?? NaN) - y) * scales.perY;
                const distance = right * right + up * up;
                if (distance < least) {
                    [best, least] = [k, distance];
                }
            }
        });
        return [best, Math.sqrt(least)];
    }
}
