// Draws one line through many places, without those that are not needed, cut to what is seen.

import { tolerance, type Outline } from "./outline";

/**
 * Strokes across a line: so many in a group, the distances of groups and of strokes in a group along it,
 * and half their length.
 */
export interface Strokes {
    count: number;
    spacing: number;
    apart: number;
    reach: number;
}

/** Squared distance in pixels below which a point is left out. */
const NEAR = 0.3;

/**
 * Puts strokes across what is drawn of a branch, the first of them near its beginning, so that a short one
 * has some, too.
 */
export class Stroker {
    private left: number;

    constructor(
        private readonly path: Outline,
        private readonly look: Strokes,
    ) {
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
export class Pen {
    /** The last place that was drawn. */
    private x = NaN;
    private y = NaN;
    private isDown = false;
    /** The last place that was met, which is not drawn yet; NaN where there is none. */
    private nextX = NaN;
    private nextY = NaN;
    /**
     * Directions from the last place drawn that pass near all places met since: the middle, and how far to
     * both sides (rad).
     */
    private middle = 0;
    private low = -Infinity;
    private high = Infinity;
    private readonly aside = tolerance();

    constructor(
        private readonly path: Outline,
        private readonly box: [number, number, number, number],
        private readonly stroker: Stroker,
    ) {}

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
        const isAhead =
            (x - this.nextX) * (this.nextX - this.x) + (y - this.nextY) * (this.nextY - this.y) >= 0;
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
        const cut =
            isInside(this.x, this.y, this.box) && isInside(this.nextX, this.nextY, this.box)
                ? WHOLE
                : clipped(this.x, this.y, dx, dy, this.box);
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
export function isBeyond(
    fromX: number,
    fromY: number,
    toX: number,
    toY: number,
    [left, top, right, bottom]: readonly [number, number, number, number],
): boolean {
    return (
        (fromX < left && toX < left) ||
        (fromX > right && toX > right) ||
        (fromY < top && toY < top) ||
        (fromY > bottom && toY > bottom)
    );
}

const WHOLE: readonly [number, number] = [0, 1];

function isInside(x: number, y: number, box: readonly [number, number, number, number]): boolean {
    return x >= box[0] && x <= box[2] && y >= box[1] && y <= box[3];
}

/**
 * The part of a piece of line within a box, as shares of its length; after Liang and Barsky, ACM Trans.
 * Graphics 3 (1984), 1-22.
 */
function clipped(
    x: number,
    y: number,
    dx: number,
    dy: number,
    box: readonly [number, number, number, number],
): readonly [number, number] | null {
    let [from, to] = [0, 1];
    const sides = [
        [-dx, x - box[0]],
        [dx, box[2] - x],
        [-dy, y - box[1]],
        [dy, box[3] - y],
    ] as const;
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
