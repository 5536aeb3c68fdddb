// Lines of branches on a canvas: cut where stability changes, cut to what is seen, without points nearer than
// half a pixel.

import type { Scales } from "./curves";
import { BRANCH_POINT, FLIP, FOLD, MARGINAL, NEIMARK_SACKER, STABLE, type Solutions } from "./data";
import { newPath, type Outline } from "./outline";
import { isBeyond, Pen, Stroker, type Strokes } from "./pen";

export interface Lines {
    stable: Outline;
    marginal: Outline;
    unstable: Outline;
    /** Short lines across both, which tell the period. */
    strokes: Outline;
    /** Places of branches of one solution, and what they look like. */
    dots: [number, number, Look][];
}

/** How a line says whether its solutions are stable. */
export type Look = "stable" | "marginal" | "unstable";

const BIFURCATION = FOLD | FLIP | NEIMARK_SACKER | BRANCH_POINT;

function lookOf(flags: number): Look {
    return (flags & STABLE) === 0 ? "unstable" : (flags & MARGINAL) === 0 ? "stable" : "marginal";
}

/** Whether a solution is marginal and neither a bifurcation nor one between others that are not marginal. */
function staysMarginal(flags: Solutions["flags"], k: number, first: number, end: number): boolean {
    const isMarginal = (other: number): boolean =>
        other >= first && other < end && ((flags[other] ?? 0) & MARGINAL) !== 0;
    return isMarginal(k) && ((flags[k] ?? 0) & BIFURCATION) === 0 && (isMarginal(k - 1) || isMarginal(k + 1));
}

/** The look of the line from one solution to the next: unstable if one is, marginal where they stay so. */
function lookBetween(flags: Solutions["flags"], k: number, first: number, end: number): Look {
    if (((flags[k] ?? 0) & (flags[k + 1] ?? 0) & STABLE) === 0) {
        return "unstable";
    }
    return staysMarginal(flags, k, first, end) || staysMarginal(flags, k + 1, first, end)
        ? "marginal"
        : "stable";
}

/** Whether a line of a stretch of solutions is marginal. */
export function hasMarginal(solutions: Solutions): boolean {
    return solutions.flags.some(
        (flags, k) => (flags & MARGINAL) !== 0 && staysMarginal(solutions.flags, k, 0, solutions.count),
    );
}

/**
 * The solutions of a branch as they are drawn: what the horizontal axis has of them, what the vertical one.
 */
export interface Course {
    across: Float64Array;
    levels: Float64Array;
    first: number;
    count: number;
}

/**
 * Lines of a stretch of solutions, as far as to these distances beyond what is seen; a level that is not
 * finite is a gap.
 */
export function linesOf(
    { flags }: Solutions,
    course: Course,
    scales: Scales,
    strokes: Strokes,
    [beside, above]: readonly [number, number] = [20, 20],
): Lines {
    const lines: Lines = {
        stable: newPath(),
        marginal: newPath(),
        unstable: newPath(),
        strokes: newPath(),
        dots: [],
    };
    const stroker = new Stroker(lines.strokes, strokes);
    const { left, top, width, height, perX, perY, lowX, lowY } = scales;
    const box: [number, number, number, number] = [
        left - beside,
        top - above,
        left + width + beside,
        top + height + above,
    ];
    const pens = {
        stable: new Pen(lines.stable, box, stroker),
        marginal: new Pen(lines.marginal, box, stroker),
        unstable: new Pen(lines.unstable, box, stroker),
    };
    const { across, levels, first, count } = course;
    let [lastX, lastY, drawn] = [NaN, NaN, 0];
    let last: Look | null = null;
    const end = first + count;
    for (let k = first; k < end; k++) {
        const x = left + ((across[k] ?? NaN) - lowX) * perX;
        const y = top + height - ((levels[k] ?? NaN) - lowY) * perY;
        if (!Number.isFinite(x) || !Number.isFinite(y)) {
            if (last !== null) {
                pens[last].lift();
                last = null;
            }
            lastX = NaN;
            continue;
        }
        if (Number.isNaN(lastX)) {
            last = null;
        } else if (isBeyond(lastX, lastY, x, y, box)) {
            if (last !== null) {
                pens[last].lift();
                last = null;
            }
            drawn++;
        } else {
            const look = lookBetween(flags, k - 1, first, end);
            const pen = pens[look];
            const next = k + 1 < end ? lookBetween(flags, k, first, end) : null;
            if (look !== last) {
                pen.begin(lastX, lastY);
                last = look;
            }
            pen.to(x, y, next !== look);
            drawn++;
        }
        [lastX, lastY] = [x, y];
    }
    if (drawn === 0 && !Number.isNaN(lastX)) {
        lines.dots.push([lastX, lastY, lookOf(flags[end - 1] ?? 0)]);
    }
    return lines;
}
