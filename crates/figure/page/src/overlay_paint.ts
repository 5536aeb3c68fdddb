// The marks of what lies over the branches: told apart by shape, and by a dot within from the marks of
// bifurcations.

import type { Look } from "./data";
import { newPath, type Outline } from "./outline";
import type { Dot } from "./overlay";

/** Half the size of a mark (CSS pixels). */
export const RADIUS = 3.6;

/** Draws marks of a kind at places in canvas pixels. */
export function drawDots(
    context: CanvasRenderingContext2D,
    layer: Dot["layer"],
    places: readonly (readonly [number, number])[],
    density: number,
    look: Look,
): void {
    const [outline, within] = [newPath(), newPath()];
    const radius = RADIUS * density;
    for (const [x, y] of places) {
        if (layer === "irregular") {
            cross(outline, x, y, 0.75 * radius);
        } else if (layer === "unknown") {
            outline.moveTo(x + radius, y);
            outline.arc(x, y, radius, 0, 2 * Math.PI);
        } else {
            outline.rect(x - radius, y - radius, 2 * radius, 2 * radius);
        }
        within.rect(x - density, y - density, 2 * density, 2 * density);
    }
    context.setLineDash([]);
    if (layer === "irregular") {
        context.lineWidth = 1.3 * density;
        context.strokeStyle = look.pale;
        context.stroke(outline as Path2D);
        return;
    }
    // A rim of paper, so that a mark is seen on a line of its colour.
    context.lineWidth = 3 * density;
    context.strokeStyle = look.paper;
    context.stroke(outline as Path2D);
    context.fillStyle = layer === "aperiodic" ? look.ink : look.paper;
    context.fill(outline as Path2D);
    context.lineWidth = 1.2 * density;
    context.strokeStyle = look.ink;
    context.stroke(outline as Path2D);
    context.fillStyle = layer === "aperiodic" ? look.paper : look.ink;
    context.fill(within as Path2D);
}

function cross(path: Outline, x: number, y: number, radius: number): void {
    path.moveTo(x - radius, y - radius);
    path.lineTo(x + radius, y + radius);
    path.moveTo(x - radius, y + radius);
    path.lineTo(x + radius, y - radius);
}
