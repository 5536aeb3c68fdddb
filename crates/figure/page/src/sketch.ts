// What the drawings of structures share.

import type { Theme } from "./theme";

export interface Sketch {
    context: CanvasRenderingContext2D;
    /** Size (CSS pixels). */
    width: number;
    height: number;
    theme: Theme;
}

/** A hatched block: what is held. */
export function hatched(
    { context }: Sketch,
    [left, top, width, height]: [number, number, number, number],
    colour: string,
): void {
    context.save();
    context.beginPath();
    context.rect(left, top, width, height);
    context.clip();
    context.strokeStyle = colour;
    context.lineWidth = 1;
    context.beginPath();
    for (let from = left - height; from < left + width; from += 6) {
        context.moveTo(from, top + height);
        context.lineTo(from + height, top);
    }
    context.stroke();
    context.restore();
    context.strokeStyle = colour;
    context.lineWidth = 1.2;
    context.strokeRect(left, top, width, height);
}

/** Length at rest below which springs and dampers are drawn as lines (CSS pixels). */
const LINE = 9;

/**
 * A spring between two places on a horizontal line.
 *
 * * `length`: at rest, from which the number of its turns follows (CSS pixels).
 */
export function spring({ context }: Sketch, from: number, to: number, y: number, length: number): void {
    const turns = length < LINE ? 0 : Math.max(2, Math.min(8, Math.round(length / 8)));
    const reach = Math.min(6, length / 5);
    const straight = 0.15 * (to - from);
    const step = (to - from - 2 * straight) / (2 * turns);
    context.beginPath();
    context.moveTo(from, y);
    context.lineTo(from + straight, y);
    for (let k = 0; k < 2 * turns; k++) {
        context.lineTo(from + straight + (k + 0.5) * step, y + (k % 2 === 0 ? -reach : reach));
    }
    context.lineTo(to - straight, y);
    context.lineTo(to, y);
    context.stroke();
}

/**
 * A damper between two places on a horizontal line: a piston in a pot, which is open towards the second
 * place; a line with a stroke across it where that has no room.
 *
 * * `length`: at rest (CSS pixels).
 */
export function dashpot({ context }: Sketch, from: number, to: number, y: number, length: number): void {
    const at = (share: number): number => from + share * (to - from);
    const reach = Math.min(6, length / 3);
    const lines = length < LINE ? [[from, y, to, y], [at(0.5), y - reach, at(0.5), y + reach]] as const : [
        [from, y, at(0.35), y],
        [at(0.35), y - reach, at(0.35), y + reach],
        [at(0.35), y - reach, at(0.65), y - reach],
        [at(0.35), y + reach, at(0.65), y + reach],
        [at(0.5), y - 0.6 * reach, at(0.5), y + 0.6 * reach],
        [at(0.5), y, to, y],
    ] as const;
    context.beginPath();
    for (const [x1, y1, x2, y2] of lines) {
        context.moveTo(x1, y1);
        context.lineTo(x2, y2);
    }
    context.stroke();
}
