// Lines of branches on a canvas: cut where stability changes, cut to what is seen, without points nearer than half a pixel.

import type { Scales } from "./curves";
import { BRANCH_POINT, FLIP, FOLD, MARGINAL, NEIMARK_SACKER, STABLE, type Solutions } from "./data";
import { newPath, tolerance, type Outline } from "./outline";

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

    constructor(private readonly path: Outline, private readonly look: Strokes) {
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

/** Draws lines through points, without those that lie on the way from one that is drawn to a later one. */
class Pen {
    /** The last place that was drawn. */
    private x = NaN;
    private y = NaN;
    private isDown = false;
    /** The last place that was met, which is not drawn yet; NaN where there is none. */
    private nextX = NaN;
    private nextY = NaN;
    /** Directions from the last place drawn that pass near all places met since: the middle, and how far to both sides (rad). */
    private middle = 0;
    private low = -Infinity;
    private high = Infinity;
    private readonly aside = tolerance();

    constructor(private readonly path: Outline, private readonly box: [number, number, number, number], private readonly stroker: Stroker) {}

    /** Draws what it has met, and goes on somewhere else. */
    lift(): void {
        this.draw();
    }

    begin(x: number, y: number): void {
        [this.x, this.y, this.isDown, this.nextX] = [x, y, false, NaN];
    }

    to(x: number, y: number, isLast: boolean): void {
        const [lastX, lastY] = Number.isNaN(this.nextX) ? [this.x, this.y] : [this.nextX, this.nextY];
        const [dx, dy] = [x - lastX, y - lastY];
        if (!isLast && dx * dx + dy * dy < NEAR) {
            return;
        }
        if (!this.goesOn(x, y)) {
            this.draw();
            this.goesOn(x, y);
        }
        [this.nextX, this.nextY] = [x, y];
        if (isLast) {
            this.draw();
        }
    }

    /** Whether one line from the last place drawn to this one passes near all between; takes it in if so. */
    private goesOn(x: number, y: number): boolean {
        const [dx, dy] = [x - this.x, y - this.y];
        const direction = Math.atan2(dy, dx);
        const open = Math.asin(Math.min(1, this.aside / Math.hypot(dx, dy)));
        if (Number.isNaN(this.nextX)) {
            [this.middle, this.low, this.high] = [direction, -open, open];
            return true;
        }
        let turn = direction - this.middle;
        turn += turn > Math.PI ? -2 * Math.PI : turn < -Math.PI ? 2 * Math.PI : 0;
        // It has to lead on, too: not back over places that were met.
        const isAhead = (x - this.nextX) * (this.nextX - this.x) + (y - this.nextY) * (this.nextY - this.y) >= 0;
        if (!isAhead || turn < this.low || turn > this.high) {
            return false;
        }
        [this.low, this.high] = [Math.max(this.low, turn - open), Math.min(this.high, turn + open)];
        return true;
    }

    /** Draws up to the last place that was met. */
    private draw(): void {
        if (Number.isNaN(this.nextX)) {
            return;
        }
        const [dx, dy] = [this.nextX - this.x, this.nextY - this.y];
        const cut = isInside(this.x, this.y, this.box) && isInside(this.nextX, this.nextY, this.box) ? WHOLE : clipped(this.x, this.y, dx, dy, this.box);
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
        [this.x, this.y, this.nextX] = [this.nextX, this.nextY, NaN];
    }
}

/** Whether a piece of line lies beyond one side of a box. */
function isBeyond(fromX: number, fromY: number, toX: number, toY: number, [left, top, right, bottom]: readonly [number, number, number, number]): boolean {
    return (fromX < left && toX < left) || (fromX > right && toX > right) || (fromY < top && toY < top) || (fromY > bottom && toY > bottom);
}

const WHOLE: readonly [number, number] = [0, 1];

function isInside(x: number, y: number, box: readonly [number, number, number, number]): boolean {
    return x >= box[0] && x <= box[2] && y >= box[1] && y <= box[3];
}

/** The part of a piece of line within a box, as shares of its length; after Liang and Barsky, ACM Trans. Graphics 3 (1984), 1-22. */
function clipped(x: number, y: number, dx: number, dy: number, box: readonly [number, number, number, number]): readonly [number, number] | null {
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

/** The solutions of a branch as they are drawn: what the horizontal axis has of them, what the vertical one. */
export interface Course {
    across: Float64Array;
    levels: Float64Array;
    first: number;
    count: number;
}

/** Lines of a stretch of solutions, as far as to these distances beyond what is seen; a level that is not finite is a gap. */
export function linesOf({ flags }: Solutions, course: Course, scales: Scales, strokes: Strokes, [beside, above]: readonly [number, number] = [20, 20]): Lines {
    const lines: Lines = { stable: newPath(), marginal: newPath(), unstable: newPath(), strokes: newPath(), dots: [] };
    const stroker = new Stroker(lines.strokes, strokes);
    const { left, top, width, height, perX, perY, lowX, lowY } = scales;
    const box: [number, number, number, number] = [left - beside, top - above, left + width + beside, top + height + above];
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
