// One mark for each kind of event, as in the printed figures, thinned where they overlap.

import { BRANCH_POINT, FLIP, FOLD, GRAZING, NEIMARK_SACKER } from "./data";
import type { Look } from "./data";

export interface Mark {
    bit: number;
    name: string;
    /** Radius (CSS pixels). */
    radius: number;
    /** Least distance between two of them (CSS pixels). */
    distance: number;
    outline: (path: Path2D, x: number, y: number, radius: number) => void;
    isFilled: boolean;
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

/** From back to front. */
export const MARKS: readonly Mark[] = [
    { bit: GRAZING, name: "grazing", radius: 3.5, distance: 9, outline: triangle, isFilled: false, isPale: true },
    { bit: NEIMARK_SACKER, name: "Neimark–Sacker", radius: 3.4, distance: 7, outline: circle, isFilled: false, isPale: false },
    { bit: FLIP, name: "flip", radius: 3.4, distance: 7, outline: diamond, isFilled: false, isPale: false },
    { bit: FOLD, name: "fold", radius: 2.2, distance: 5, outline: circle, isFilled: true, isPale: false },
    { bit: BRANCH_POINT, name: "branch point", radius: 3.4, distance: 7, outline: square, isFilled: false, isPale: false },
];

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
    if (!mark.isPale) {
        context.fill(path);
    }
    context.strokeStyle = mark.isFilled ? look.paper : mark.isPale ? look.pale : look.ink;
    context.stroke(path);
}
