// The structure at an instant of an orbit.

import type { Stop, Structure } from "./data";
import type { Orbit } from "./orbit";

export interface Pose {
    /** Displacement of each place (m). */
    places: number[];
    /** Displacement of each node of the mesh (m). */
    mesh: [number, number, number][];
    /** Displacement of each support that moves (m). */
    supports: number[];
    /** Whether a force of each local element acts in this step, or an impulse did just before. */
    pressed: boolean[];
}

/** For how long an impact is seen, in excitation periods. */
const SEEN = 0.03;

/** A periodic series between its samples, by cubics through four of them. */
export function smooth(values: Float64Array, place: number): number {
    const count = values.length;
    const at = (k: number): number => values[((k % count) + count) % count] ?? 0;
    const before = Math.floor(place);
    const t = place - before;
    const [a, b, c, d] = [at(before - 1), at(before), at(before + 1), at(before + 2)];
    return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

/** The samples of each support over one excitation period. */
export function supportsOf(orbit: Orbit, count: number): Float64Array[] {
    const each = orbit.support.length / Math.max(1, count);
    return Array.from({ length: count }, (_, k) => orbit.support.subarray(k * each, (k + 1) * each));
}

/** What carries a stop (m). */
export function carrierOf(stop: Stop, pose: Pose): number {
    if (stop.other !== null) {
        return pose.places[stop.other] ?? 0;
    }
    return stop.rides !== null ? (pose.supports[stop.rides] ?? 0) : 0;
}

/** The pose at an instant, in excitation periods since phase 0. */
export function poseAt(structure: Structure, orbit: Orbit, instant: number): Pose {
    const share = instant / orbit.period;
    const modes = orbit.modes.map((values) => smooth(values, share * values.length));
    const samples = supportsOf(orbit, structure.supports.length);
    const supports = samples.map((values) => smooth(values, instant * values.length));
    const moved = (shape: number[], ratios: number[]): number =>
        modes.reduce(
            (sum, value, mode) => sum + value * (shape[mode] ?? 0),
            supports.reduce((sum, value, k) => sum + value * (ratios[k] ?? 0), 0),
        );
    const places = structure.places.map((place) => moved(place.shape, place.support));
    const mesh = (structure.mesh?.shapes ?? []).map((shape, node): [number, number, number] => {
        const ratios = structure.mesh?.support[node] ?? [[], [], []];
        return [moved(shape[0], ratios[0]), moved(shape[1], ratios[1]), moved(shape[2], ratios[2])];
    });
    const force = (values: Float64Array): number => {
        const step = 2 * Math.min(values.length / 2 - 1, Math.floor((share * values.length) / 2));
        return Math.max(Math.abs(values[step] ?? 0), Math.abs(values[step + 1] ?? 0));
    };
    const isStruck = (element: number): boolean =>
        orbit.impulses.some(
            (impulse) =>
                impulse.element === element &&
                (instant - impulse.cycles + orbit.period) % orbit.period < SEEN,
        );
    const pressed = orbit.forces.map((values, k) => force(values) > 0 || isStruck(k));
    return { places, mesh, supports, pressed };
}

/** Largest displacement of any place, or of a support (m). */
export function largestDisplacement(structure: Structure, orbit: Orbit): number {
    const steps = orbit.modes[0]?.length ?? 0;
    let largest = 0;
    for (let step = 0; step < steps; step++) {
        const { places, supports } = poseAt(
            { ...structure, mesh: null },
            orbit,
            (step * orbit.period) / steps,
        );
        largest = Math.max(largest, ...supports.map(Math.abs), ...places.map(Math.abs));
    }
    return largest;
}
