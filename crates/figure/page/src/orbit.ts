// Orbits, decoded one at a time.

import { bytesOf } from "./base64";
import type { Meta, Solutions } from "./data";
import { smooth } from "./motion";
import { readRecord, type OrbitRecord } from "./record";

/**
 * An orbit over its period; of accelerations and forces the least and the largest from each sample to the
 * next, in their order in time.
 */
export interface Orbit extends OrbitRecord {
    /** Number of the solution that it belongs to. */
    solution: number;
    period: number;
    /**
     * Displacements over the excitation periods since phase 0, as a line that is drawn: to the end of the
     * period.
     */
    course: [Float64Array, Float64Array];
    /**
     * Displacements and velocities, those within contacts among them, with a gap where an impact makes the
     * velocity jump.
     */
    portrait: [Float64Array, Float64Array];
}

/**
 * Place in the list of the carried orbits of the one nearest to a solution on its branch; -1 where its branch
 * has none.
 */
export function nearestOrbit(meta: Meta, solutions: Solutions, solution: number): number {
    const carried = meta.orbits.solutions;
    let low = 0;
    let high = carried.length;
    while (low < high) {
        const middle = (low + high) >> 1;
        if ((carried[middle] ?? 0) < solution) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    let best = -1;
    let least = Infinity;
    for (const place of [low - 1, low]) {
        const other = carried[place];
        if (other !== undefined && solutions.branch[other] === solutions.branch[solution]) {
            const distance = Math.abs(other - solution);
            if (distance < least) {
                [best, least] = [place, distance];
            }
        }
    }
    return best;
}

/** Where each record begins, in bytes, and behind the last one where it ends. */
export function recordPlaces(lengths: readonly number[]): Uint32Array {
    const places = new Uint32Array(lengths.length + 1);
    lengths.forEach((length, k) => (places[k + 1] = (places[k] ?? 0) + length));
    return places;
}

/**
 * The orbit at a place in the list of those carried; `text` is the base64 text of all, of whose records each
 * has a multiple of three bytes.
 */
export function readOrbit(
    meta: Meta,
    solutions: Solutions,
    text: string,
    places: Uint32Array,
    place: number,
): Orbit {
    const [begin = 0, end = 0] = places.subarray(place, place + 2);
    const record = readRecord(bytesOf(text.slice((begin / 3) * 4, (end / 3) * 4)));
    const solution = meta.orbits.solutions[place] ?? 0;
    const period = meta.branches[solutions.branch[solution] ?? 0]?.period ?? 1;
    const frequency = solutions.frequency[solution] ?? NaN;
    const course = courseOf(record, period, frequency);
    return { ...record, solution, period, course, portrait: portraitOf(record, period) };
}

/** Parts of a step that is drawn by cubics. */
const PARTS = 4;

/**
 * Displacements by the cubics that have the velocities of the samples, which follow a contact of a few
 * samples, too; with a corner at each impact.
 */
function courseOf(
    { displacement, velocity, impulses }: OrbitRecord,
    period: number,
    frequency: number,
): [Float64Array, Float64Array] {
    const [times, values]: [number[], number[]] = [[], []];
    const count = displacement.length;
    const step = period / count;
    const at = (series: Float64Array, k: number): number => series[k % count] ?? NaN;
    let next = 0;
    for (let k = 0; k < count; k++) {
        const [from, to] = [at(displacement, k), at(displacement, k + 1)];
        const [begin, end] = [(at(velocity, k) * step) / frequency, (at(velocity, k + 1) * step) / frequency];
        times.push(k * step);
        values.push(from);
        const corners = impulses.slice(next).filter(({ cycles }) => cycles < (k + 1) * step);
        next += corners.length;
        for (const { cycles, displacement: corner } of corners) {
            times.push(cycles);
            values.push(corner);
        }
        for (let part = 1; corners.length === 0 && part < PARTS; part++) {
            const t = part / PARTS;
            times.push((k + t) * step);
            values.push(from + t * t * (3 - 2 * t) * (to - from) + t * (1 - t) * ((1 - t) * begin - t * end));
        }
    }
    times.push(period);
    values.push(at(displacement, 0));
    return [Float64Array.from(times), Float64Array.from(values)];
}

/**
 * Samples with what lies between them: points within contacts, and both ends of the jumps of impacts with a
 * gap between. Away from both the motion is smooth, and cubics stand between samples.
 */
function portraitOf(
    { displacement, velocity, inContacts, impulses }: OrbitRecord,
    period: number,
): [Float64Array, Float64Array] {
    const between = new Map<number, [number, number][]>();
    const add = (step: number, ...points: [number, number][]): void => {
        between.set(step, [...(between.get(step) ?? []), ...points]);
    };
    for (const { cycles, displacement: at, velocity: [before, after] } of impulses) {
        add(Math.floor((cycles / period) * displacement.length), [at, before], [NaN, NaN], [at, after]);
    }
    const [steps, inDisplacement, inVelocity] = inContacts;
    steps.forEach((step, k) => add(Math.round(step), [inDisplacement[k] ?? NaN, inVelocity[k] ?? NaN]));
    const [x, y]: [number[], number[]] = [[], []];
    const count = displacement.length;
    const isStruck = (step: number): boolean => between.has((step + count) % count);
    for (let k = 0; k < count; k++) {
        x.push(displacement[k] ?? NaN);
        y.push(velocity[k] ?? NaN);
        const isSmooth = !isStruck(k - 1) && !isStruck(k) && !isStruck(k + 1);
        for (let part = 1; isSmooth && part < PARTS; part++) {
            x.push(smooth(displacement, k + part / PARTS));
            y.push(smooth(velocity, k + part / PARTS));
        }
        for (const [across, up] of between.get(k) ?? []) {
            x.push(across);
            y.push(up);
        }
    }
    return [Float64Array.from(x), Float64Array.from(y)];
}
