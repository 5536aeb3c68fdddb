// One mark for each kind of event, as in the printed figures, thinned where they overlap.

import { BRANCH_POINT, FLIP, FOLD, GRAZING, MARGINAL, NEIMARK_SACKER, STABLE, type Look, type Solutions } from "./data";

export interface Mark {
    /** The events that have it. */
    bits: number;
    /** Whether it is for solutions that are unstable on both sides; undefined for both. */
    ofUnstable?: boolean;
    name: string;
    /** Radius (CSS pixels). */
    radius: number;
    /** Least distance between two of them (CSS pixels). */
    distance: number;
    outline: (path: Path2D, x: number, y: number, radius: number) => void;
    isFilled: boolean;
    /** Whether it stands behind the lines: some events are so frequent that they would bury them. */
    isPale: boolean;
}

const circle = (path: Path2D, x: number, y: number, radius: number): void => {
    path.moveTo(x + radius, y);
    path.arc(x, y, radius, 0, 2 * Math.PI);
};

const polygon = (corners: readonly (readonly [number, number])[]) => (path: Path2D, x: number, y: number, radius: number): void => {
    corners.forEach(([across, down], k) => {
        const [toX, toY] = [x + across * radius, y + down * radius];
        if (k === 0) {
            path.moveTo(toX, toY);
        } else {
            path.lineTo(toX, toY);
        }
    });
    path.closePath();
};

const diamond = polygon([[0, -1.25], [1.25, 0], [0, 1.25], [-1.25, 0]]);
const square = polygon([[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]]);
const triangle = polygon([[0, -1.1], [1, 0.8], [-1, 0.8]]);

const CHANGES = NEIMARK_SACKER | FLIP;

/** From back to front. A fold lies behind the change of stability at its place: a dot within a mark means a measured point. */
export const MARKS: readonly Mark[] = [
    { bits: GRAZING, name: "grazing", radius: 3.2, distance: 11, outline: triangle, isFilled: false, isPale: true },
    { bits: CHANGES, ofUnstable: true, name: "flip or Neimark–Sacker of unstable solutions", radius: 2, distance: 9, outline: circle, isFilled: false, isPale: true },
    { bits: FOLD, name: "fold", radius: 2, distance: 5, outline: circle, isFilled: true, isPale: false },
    { bits: NEIMARK_SACKER, ofUnstable: false, name: "Neimark–Sacker", radius: 3.4, distance: 7, outline: circle, isFilled: false, isPale: false },
    { bits: FLIP, ofUnstable: false, name: "flip", radius: 3.4, distance: 7, outline: diamond, isFilled: false, isPale: false },
    { bits: BRANCH_POINT, name: "branch point", radius: 3.2, distance: 7, outline: square, isFilled: false, isPale: false },
];

/** Whether a solution is stable, or one beside it on its branch. */
export function besideStable(solutions: Solutions, k: number): boolean {
    const isStable = (other: number): boolean => solutions.branch[other] === solutions.branch[k] && ((solutions.flags[other] ?? 0) & STABLE) !== 0;
    return isStable(k) || isStable(k - 1) || isStable(k + 1);
}

/** The solutions that have each of the marks. */
export function markedSolutions(solutions: Solutions): Map<Mark, number[]> {
    const marked = new Map(MARKS.map((mark) => [mark, [] as number[]]));
    for (let k = 0; k < solutions.count; k++) {
        const flags = solutions.flags[k] ?? 0;
        if ((flags & ~(STABLE | MARGINAL)) !== 0) {
            const ofUnstable = !besideStable(solutions, k);
            MARKS.filter((mark) => (flags & mark.bits) !== 0 && (mark.ofUnstable ?? ofUnstable) === ofUnstable).forEach((mark) => marked.get(mark)?.push(k));
        }
    }
    return marked;
}

/** Names of the events of a solution, joined. */
export function eventNames(flags: number): string {
    const names = [[FOLD, "fold"], [FLIP, "flip"], [NEIMARK_SACKER, "Neimark–Sacker"], [BRANCH_POINT, "branch point"], [GRAZING, "grazing"]] as const;
    return names.filter(([bit]) => (flags & bit) !== 0).map(([, name]) => name).join(", ");
}

/** A mark that another one stands for where both are at one place: at each flip a branch of twice the period begins. */
export function standsFor(mark: Mark): (other: Mark) => boolean {
    return (other) => (mark.bits & BRANCH_POINT) !== 0 && (other.bits & FLIP) !== 0;
}

/** Of the places those that are no place of the others, as far as can be seen (canvas pixels). */
export function apart(places: readonly [number, number][], others: readonly [number, number][], density: number): [number, number][] {
    const cell = density;
    const key = (column: number, row: number): number => column * 65536 + row;
    const taken = new Set(others.map(([x, y]) => key(Math.floor(x / cell), Math.floor(y / cell))));
    const beside = [-1, 0, 1];
    return places.filter(([x, y]) => {
        const [column, row] = [Math.floor(x / cell), Math.floor(y / cell)];
        return !beside.some((across) => beside.some((down) => taken.has(key(column + across, row + down))));
    });
}

/** The marks of a legend with their names: where flips stand for branch points theirs says so, and branch points are named only if some lie elsewhere. */
export function namedMarks(solutions: Solutions): [Mark, string][] {
    const marked = markedSolutions(solutions);
    const { frequency, maxima: { displacement } } = solutions;
    const extent = (column: ArrayLike<number>): [number, number] => {
        const ends: [number, number] = [Infinity, -Infinity];
        for (let k = 0; k < column.length; k++) {
            const value = column[k] ?? NaN;
            if (Number.isFinite(value)) {
                ends[0] = Math.min(ends[0], value);
                ends[1] = Math.max(ends[1], value);
            }
        }
        return ends;
    };
    const [[least, greatest], [, largest]] = [extent(frequency), extent(displacement)];
    // In ten-thousandths of the diagram.
    const [perHz, perM] = [1e4 / (greatest - least || 1), 1e4 / (largest || 1)];
    const place = (k: number): [number, number] => [((frequency[k] ?? NaN) - least) * perHz, (displacement[k] ?? NaN) * perM];
    const places = (mark: Mark): [number, number][] => (marked.get(mark) ?? []).map(place);
    const named = MARKS.filter((mark) => places(mark).length > 0).map((mark): [Mark, string, number] => {
        const others = MARKS.filter(standsFor(mark)).flatMap(places);
        return [mark, mark.name, apart(places(mark), others, 1).length];
    });
    const isJoined = named.some(([mark, , left]) => left < places(mark).length);
    const name = (mark: Mark, plain: string): string => (isJoined && mark.name === "flip" ? "flip, branch point of twice the period" : plain);
    return named.filter(([, , left]) => left > 0).map(([mark, plain]) => [mark, name(mark, plain)]);
}

/** Draws marks of a kind at places in canvas pixels, those that do not cover another one. */
export function drawMarks(context: CanvasRenderingContext2D, mark: Mark, places: readonly [number, number][], density: number, look: Look): void {
    const cell = mark.distance * density;
    const taken = new Set<number>();
    const path = new Path2D();
    for (const [x, y] of places) {
        const key = Math.round(x / cell) * 65536 + Math.round(y / cell);
        if (!taken.has(key)) {
            taken.add(key);
            mark.outline(path, x, y, mark.radius * density);
        }
    }
    context.lineWidth = density;
    context.setLineDash([]);
    context.fillStyle = mark.isFilled ? look.ink : look.paper;
    context.fill(path);
    context.strokeStyle = mark.isFilled ? look.paper : mark.isPale ? look.pale : look.ink;
    context.stroke(path);
}
