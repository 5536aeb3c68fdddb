// The frame of a complex plane with the unit circle: what it holds, and what lies outside.

import type { Multiplier } from "./multiplier_table";

/**
 * Largest modulus for which the frame grows; where one is larger, the frame holds the unit circle and what is
 * near it.
 */
const FARTHEST = 3.5;

/** Distances of the edges of a frame from 0, along the real and the imaginary axis. */
export type Edges = readonly [across: number, up: number];

/**
 * Edges of a frame in which a circle is one.
 *
 * Its shorter side holds the unit circle, and every multiplier where none is far away.
 *
 * * `width`, `height`: of the frame, in the same unit.
 */
export function edgesOf(multipliers: readonly Multiplier[], width: number, height: number): Edges {
    const largest = multipliers.reduce((most, one) => Math.max(most, Math.hypot(...one)), 0);
    const reach = largest <= FARTHEST ? Math.max(1.25, 1.15 * largest) : 1.6;
    const shorter = Math.max(1, Math.min(width, height));
    return [(reach * Math.max(width, shorter)) / shorter, (reach * Math.max(height, shorter)) / shorter];
}

/** Whether a multiplier lies in a frame; one that is not finite does not. */
export function isWithin([re, im]: Multiplier, [across, up]: Edges): boolean {
    return Math.abs(re) <= across && Math.abs(im) <= up;
}
