// One mark for each kind of event, as in the printed figures.

import {
    BRANCH_POINT,
    FLIP,
    FOLD,
    GRAZING,
    MARGINAL,
    NEIMARK_SACKER,
    STABLE,
    type Look,
    type Meta,
    type Solutions,
} from "./data";
import { newPath, type Outline } from "./outline";
import type { Layer } from "./state";

export interface Mark {
    layer: Layer;
    name: string;
    /** Radius (CSS pixels). */
    radius: number;
    /** Room that it takes around its place (CSS pixels): two marks are no nearer than theirs together. */
    room: number;
    outline: (path: Outline, x: number, y: number, radius: number) => void;
    isFilled: boolean;
    /** Whether it stands behind the lines: some events are so frequent that they would bury them. */
    isPale: boolean;
}

const circle = (path: Outline, x: number, y: number, radius: number): void => {
    path.moveTo(x + radius, y);
    path.arc(x, y, radius, 0, 2 * Math.PI);
};

const polygon =
    (corners: readonly (readonly [number, number])[]) =>
    (path: Outline, x: number, y: number, radius: number): void => {
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

const diamond = polygon([
    [0, -1.25],
    [1.25, 0],
    [0, 1.25],
    [-1.25, 0],
]);
const square = polygon([
    [-0.9, -0.9],
    [0.9, -0.9],
    [0.9, 0.9],
    [-0.9, 0.9],
]);

/** Equilateral, its centre at the place. */
const triangle = polygon([
    [0, -1],
    [0.866, 0.5],
    [-0.866, 0.5],
]);

/** The first of those that an event can have is its mark: a flip stands for the branch point on it. */
export const MARKS: readonly Mark[] = [
    { layer: "flip", name: "flip", radius: 3.4, room: 4.6, outline: diamond, isFilled: false, isPale: false },
    {
        layer: "neimark-sacker",
        name: "Neimark–Sacker",
        radius: 3.4,
        room: 4.4,
        outline: circle,
        isFilled: false,
        isPale: false,
    },
    {
        layer: "branch-point",
        name: "branch point",
        radius: 3.2,
        room: 4.4,
        outline: square,
        isFilled: false,
        isPale: false,
    },
    {
        layer: "fold-at-grazing",
        name: "fold at a grazing",
        radius: 3,
        room: 4,
        outline: triangle,
        isFilled: true,
        isPale: false,
    },
    { layer: "fold", name: "fold", radius: 2.1, room: 3.4, outline: circle, isFilled: true, isPale: false },
    {
        layer: "of-unstable",
        name: "flip or Neimark–Sacker of unstable solutions",
        radius: 2,
        room: 4.5,
        outline: circle,
        isFilled: false,
        isPale: true,
    },
    {
        layer: "grazing",
        name: "grazing",
        radius: 3.4,
        room: 5.5,
        outline: triangle,
        isFilled: false,
        isPale: true,
    },
];

/** Whether a solution is stable, or one beside it on its branch. */
export function besideStable(solutions: Solutions, k: number): boolean {
    const isStable = (other: number): boolean =>
        solutions.branch[other] === solutions.branch[k] && ((solutions.flags[other] ?? 0) & STABLE) !== 0;
    return isStable(k) || isStable(k - 1) || isStable(k + 1);
}

/** Solutions with an event of whichever kind. */
const EVENTS = FOLD | FLIP | NEIMARK_SACKER | BRANCH_POINT | GRAZING;

/** Whether a grazing lies at the place of a solution: on itself, or on one beside it that is nowhere else. */
function grazesAt(solutions: Solutions, k: number): boolean {
    const { flags, frequency, branch } = solutions;
    const near = (other: number): boolean =>
        branch[other] === branch[k] &&
        Math.abs((frequency[other] ?? NaN) - (frequency[k] ?? NaN)) < 1e-7 * Math.abs(frequency[k] ?? NaN);
    return [k, k - 1, k + 1].some(
        (other) => ((flags[other] ?? 0) & GRAZING) !== 0 && (other === k || near(other)),
    );
}

/** The kinds of marks that a solution can have, those that say most first. */
function kindsOf(solutions: Solutions, k: number, ofStable: boolean): Layer[] {
    const flags = solutions.flags[k] ?? 0;
    const has = (bit: number): boolean => (flags & bit) !== 0;
    const kinds: [boolean, Layer][] = [
        [has(FLIP) && ofStable, "flip"],
        [has(NEIMARK_SACKER) && ofStable, "neimark-sacker"],
        [has(BRANCH_POINT), "branch-point"],
        [has(FOLD) && grazesAt(solutions, k), "fold-at-grazing"],
        [has(FOLD) && !grazesAt(solutions, k), "fold"],
        [has(FLIP | NEIMARK_SACKER) && !ofStable, "of-unstable"],
        [has(GRAZING) && !has(FOLD), "grazing"],
    ];
    return kinds.filter(([is]) => is).map(([, layer]) => layer);
}

/** A solution with an event. */
export interface Marked {
    solution: number;
    kinds: Layer[];
}

/**
 * The solutions with events, in the order in which they take their places: bifurcations of stable solutions
 * first, then by kind, then along the branches.
 */
export function markedSolutions(solutions: Solutions): Marked[] {
    const rank = new Map(MARKS.map(({ layer }, place) => [layer, place]));
    const found: (Marked & { rank: number })[] = [];
    for (let k = 0; k < solutions.count; k++) {
        if (((solutions.flags[k] ?? 0) & EVENTS) !== 0) {
            const ofStable = besideStable(solutions, k);
            const kinds = kindsOf(solutions, k, ofStable);
            const own = rank.get(kinds[0] ?? "grazing") ?? 0;
            found.push({
                solution: k,
                kinds,
                rank: own + (ofStable && kinds[0] !== "grazing" ? 0 : MARKS.length),
            });
        }
    }
    return found.sort((a, b) => a.rank - b.rank || a.solution - b.solution);
}

/**
 * Numbers of the special points, from 1 along the branches, by their solutions: those that `run --from
 * FOLDER:NUMBER` takes.
 */
export function eventNumbers(meta: Meta, solutions: Solutions): Map<number, number> {
    const numbers = new Map<number, number>();
    for (const { first, count, over } of meta.branches) {
        for (let k = first; k < first + count && over === 0; k++) {
            if (((solutions.flags[k] ?? 0) & EVENTS) !== 0) {
                numbers.set(k, numbers.size + 1);
            }
        }
    }
    return numbers;
}

/** Stability and events of a solution as tables of results write them. */
export function eventWords(flags: number): { stability: string; events: string } {
    const words = [
        [FOLD, "fold"],
        [FLIP, "flip"],
        [NEIMARK_SACKER, "neimark-sacker"],
        [BRANCH_POINT, "branch-point"],
        [GRAZING, "grazing"],
    ] as const;
    const stability = (flags & MARGINAL) !== 0 ? "marginal" : (flags & STABLE) !== 0 ? "true" : "false";
    return {
        stability,
        events: words
            .filter(([bit]) => (flags & bit) !== 0)
            .map(([, word]) => word)
            .join("+"),
    };
}

/** Names of the events of a solution, joined. */
export function eventNames(flags: number): string {
    const names = [
        [FOLD, "fold"],
        [FLIP, "flip"],
        [NEIMARK_SACKER, "Neimark–Sacker"],
        [BRANCH_POINT, "branch point"],
        [GRAZING, "grazing"],
    ] as const;
    return names
        .filter(([bit]) => (flags & bit) !== 0)
        .map(([, name]) => name)
        .join(", ");
}

/**
 * The marks of a legend with their names: where flips stand for branch points theirs says so, and branch
 * points are named only if some lie elsewhere.
 */
export function namedMarks(marked: readonly Marked[], solutions: Solutions): [Mark, string][] {
    const {
        frequency,
        maxima: { displacement },
    } = solutions;
    const of = (layer: Layer): number[] =>
        marked.filter(({ kinds }) => kinds.includes(layer)).map(({ solution }) => solution);
    const key = (k: number, across: number, up: number): string =>
        `${Math.round(1e5 * Math.log(frequency[k] ?? NaN)) + across}:` +
        `${Math.round(1e5 * Math.log(displacement[k] ?? NaN)) + up}`;
    const flips = new Set(of("flip").map((k) => key(k, 0, 0)));
    const beside = [-1, 0, 1];
    const branchPoints = of("branch-point");
    const alone = branchPoints.filter(
        (k) => !beside.some((across) => beside.some((up) => flips.has(key(k, across, up)))),
    );
    const isJoined = alone.length < branchPoints.length;
    const name = ({ layer, name: plain }: Mark): string =>
        isJoined && layer === "flip" ? "flip, branch point of twice the period" : plain;
    const isThere = ({ layer }: Mark): boolean =>
        layer === "branch-point" ? alone.length > 0 : of(layer).length > 0;
    return MARKS.filter(isThere).map((mark) => [mark, name(mark)]);
}

/** Draws marks of a kind at places in canvas pixels. */
export function drawMarks(
    context: CanvasRenderingContext2D,
    mark: Mark,
    places: readonly (readonly [number, number])[],
    density: number,
    look: Look,
): void {
    const path = newPath();
    for (const [x, y] of places) {
        mark.outline(path, x, y, mark.radius * density);
    }
    context.setLineDash([]);
    context.lineWidth = (mark.isFilled ? 0.6 : 1.1) * density;
    context.fillStyle = mark.isFilled ? look.ink : look.paper;
    context.fill(path as Path2D);
    context.strokeStyle = mark.isFilled ? look.paper : mark.isPale ? look.pale : look.ink;
    context.stroke(path as Path2D);
}
