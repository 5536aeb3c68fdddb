// The solutions as they are drawn: a quantity in the unit of its axis, on a linear or logarithmic scale, in pixels.

import type { Measured, Quantity, Solutions } from "./data";
import { MEASURES } from "./format";
import type { Range } from "./frame";

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
    return { left, top, width, height, perX: width / (highX - lowX), perY: height / (highY - lowY), lowX, lowY, log: range.logY };
}

export class Curves {
    private readonly kept = new Map<string, Float64Array>();

    constructor(readonly solutions: Solutions) {}

    /** A quantity in the unit of its axis; its logarithm to base 10 where the axis is logarithmic, NaN where it has none. */
    levels(quantity: Quantity, log: boolean): Float64Array {
        const key = `${quantity} ${log}`;
        let levels = this.kept.get(key);
        if (levels === undefined) {
            const { factor } = MEASURES[quantity];
            const of = (value: number): number => {
                const scaled = factor * value;
                return log ? (scaled > 0 ? Math.log10(scaled) : NaN) : scaled;
            };
            levels = Float64Array.from(this.solutions.maxima[quantity], of);
            this.kept.set(key, levels);
        }
        return levels;
    }

    /** Quantities of which there is something, measured ones among them: without contacts over a time there are no forces. */
    present(measured: readonly Measured[]): Quantity[] {
        const always: readonly Quantity[] = ["displacement", "acceleration", ...measured.map(({ quantity }) => quantity)];
        return (Object.keys(MEASURES) as Quantity[]).filter((quantity) => always.includes(quantity) || this.solutions.maxima[quantity].some((value) => value > 0));
    }

    /** Least and largest of a quantity among the branches that are drawn, and of other values, widened a little; null where nothing is. */
    extent(quantity: Quantity, log: boolean, hidden: ReadonlySet<number>, others: readonly number[] = []): [number, number] | null {
        const levels = this.levels(quantity, log);
        let [low, high] = [Infinity, -Infinity];
        for (let k = 0; k < levels.length; k++) {
            const level = levels[k] ?? NaN;
            if (Number.isFinite(level) && !hidden.has(this.solutions.branch[k] ?? 0)) {
                low = Math.min(low, level);
                high = Math.max(high, level);
            }
        }
        for (const value of others) {
            const level = log ? Math.log10(value) : value;
            if (Number.isFinite(level)) {
                [low, high] = [Math.min(low, level), Math.max(high, level)];
            }
        }
        if (low > high) {
            return null;
        }
        const margin = 0.04 * (high - low || Math.abs(high) || 1);
        if (log) {
            return [10 ** (low - margin), 10 ** (high + margin)];
        }
        return [low >= 0 && low < 0.3 * high ? 0 : low - margin, high + margin];
    }

    /** Whether values span so much that a logarithmic axis is the better one. */
    spansMuch(quantity: Quantity): boolean {
        const extent = this.extent(quantity, true, new Set());
        return extent !== null && extent[1] / extent[0] > 40;
    }

    /** The solution nearest to a place in canvas pixels, within so many of them, and its distance; -1 for none. */
    nearest(quantity: Quantity, scales: Scales, hidden: ReadonlySet<number>, place: [number, number], within: number): [solution: number, distance: number] {
        const levels = this.levels(quantity, scales.log);
        const { frequency, branch } = this.solutions;
        const [x, y] = [(place[0] - scales.left) / scales.perX + scales.lowX, (scales.top + scales.height - place[1]) / scales.perY + scales.lowY];
        let [best, least] = [-1, within * within];
        for (let k = 0; k < levels.length; k++) {
            const across = ((frequency[k] ?? NaN) - x) * scales.perX;
            const up = ((levels[k] ?? NaN) - y) * scales.perY;
            const distance = across * across + up * up;
            if (distance < least && !hidden.has(branch[k] ?? 0)) {
                [best, least] = [k, distance];
            }
        }
        return [best, Math.sqrt(least)];
    }
}
