// Lines of branches on a canvas: cut where stability changes, cut to what is seen, without points nearer than half a pixel.

import { BRANCH_POINT, FLIP, FOLD, MARGINAL, NEIMARK_SACKER, STABLE, type Solutions } from "./data";
import type { Scales } from "./curves";

export interface Lines {
    stable: Path2D;
    marginal: Path2D;
    unstable: Path2D;
    /** Short lines across both, which tell the period. */
    strokes: Path2D;
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
    const isMarginal = (other: number): boolean => other >= first && other < end && ((flags[other] ?? 0) & MARGINAL) !== 0;
    return isMarginal(k) && ((flags[k] ?? 0) & BIFURCATION) === 0 && (isMarginal(k - 1) || isMarginal(k + 1));
}

/** The look of the line from one solution to the next: unstable if one is, marginal where they stay so. */
function lookBetween(flags: Solutions["flags"], k: number, first: number, end: number): Look {
    if (((flags[k] ?? 0) & (flags[k + 1] ?? 0) & STABLE) === 0) {
        return "unstable";
    }
    return staysMarginal(flags, k, first, end) || staysMarginal(flags, k + 1, first, end) ? "marginal" : "stable";
}

/** Whether a line of a stretch of solutions is marginal. */
export function hasMarginal(solutions: Solutions): boolean {
    return solutions.flags.some((flags, k) => (flags & MARGINAL) !== 0 && staysMarginal(solutions.flags, k, 0, solutions.count));
}

/** Strokes across a line: so many in a group, the distances of groups and of strokes in a group along it, and half their length. */
export interface Strokes {
    count: number;
    spacing: number;
    apart: number;
    reach: number;
}

/** Squared distance in pixels below which a point is left out. */
const NEAR = 0.3;

/** Puts strokes across what is drawn of a branch, the first of them near its beginning, so that a short one has some, too. */
class Stroker {
    private left: number;

    constructor(private readonly path: Path2D, private readonly look: Strokes) {
        this.left = look.count > 0 ? look.spacing / 6 : Infinity;
    }

    along(x: number, y: number, dx: number, dy: number): void {
        const length = Math.hypot(dx, dy);
        const { count, spacing, apart, reach } = this.look;
        for (; this.left <= length && length > 0; this.left += spacing) {
            for (let k = 0; k < count; k++) {
                const share = (this.left + (k - (count - 1) / 2) * apart) / length;
                const [atX, atY] = [x + share * dx, y + share * dy];
                const [acrossX, acrossY] = [(-dy / length) * reach, (dx / length) * reach];
                this.path.moveTo(atX - acrossX, atY - acrossY);
                this.path.lineTo(atX + acrossX, atY + acrossY);
            }
        }
        this.left -= length;
    }
}

class Pen {
    private x = NaN;
    private y = NaN;
    private isDown = false;

    constructor(private readonly path: Path2D, private readonly box: [number, number, number, number], private readonly stroker: Stroker) {}

    begin(x: number, y: number): void {
        [this.x, this.y, this.isDown] = [x, y, false];
    }

    to(x: number, y: number, isLast: boolean): void {
        const [dx, dy] = [x - this.x, y - this.y];
        if (!isLast && dx * dx + dy * dy < NEAR) {
            return;
        }
        const cut = clipped(this.x, this.y, dx, dy, this.box);
        if (cut === null) {
            this.isDown = false;
        } else {
            const [from, to] = cut;
            if (!this.isDown || from > 0) {
                this.path.moveTo(this.x + from * dx, this.y + from * dy);
            }
            this.path.lineTo(this.x + to * dx, this.y + to * dy);
            this.stroker.along(this.x + from * dx, this.y + from * dy, (to - from) * dx, (to - from) * dy);
            this.isDown = to === 1;
        }
        [this.x, this.y] = [x, y];
    }
}

/** The part of a piece of line within a box, as shares of its length; after Liang and Barsky, ACM Trans. Graphics 3 (1984), 1-22. */
function clipped(x: number, y: number, dx: number, dy: number, box: [number, number, number, number]): [number, number] | null {
    let [from, to] = [0, 1];
    const sides = [[-dx, x - box[0]], [dx, box[2] - x], [-dy, y - box[1]], [dy, box[3] - y]] as const;
    for (const [along, left] of sides) {
        if (along === 0) {
            if (left < 0) {
                return null;
            }
        } else if (along < 0) {
            from = Math.max(from, left / along);
        } else {
            to = Math.min(to, left / along);
        }
    }
    return from <= to ? [from, to] : null;
}

/** Lines of a stretch of solutions; a level that is not finite is a gap. */
export function linesOf(solutions: Solutions, levels: Float64Array, first: number, count: number, scales: Scales, strokes: Strokes): Lines {
    const lines: Lines = { stable: new Path2D(), marginal: new Path2D(), unstable: new Path2D(), strokes: new Path2D(), dots: [] };
    const stroker = new Stroker(lines.strokes, strokes);
    const { left, top, width, height, perX, perY, lowX, lowY } = scales;
    const margin = 20;
    const box: [number, number, number, number] = [left - margin, top - margin, left + width + margin, top + height + margin];
    const pens = {
        stable: new Pen(lines.stable, box, stroker),
        marginal: new Pen(lines.marginal, box, stroker),
        unstable: new Pen(lines.unstable, box, stroker),
    };
    const { frequency, flags } = solutions;
    let [lastX, lastY, drawn] = [NaN, NaN, 0];
    let last: Look | null = null;
    const end = first + count;
    for (let k = first; k < end; k++) {
        const x = left + ((frequency[k] ?? NaN) - lowX) * perX;
        const y = top + height - ((levels[k] ?? NaN) - lowY) * perY;
        if (!Number.isFinite(x) || !Number.isFinite(y)) {
            lastX = NaN;
            continue;
        }
        if (Number.isNaN(lastX)) {
            last = null;
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
