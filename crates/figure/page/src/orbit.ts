// Orbits, decoded one at a time from their records (see orbits.rs of the figure crate).

import { bytesOf } from "./base64";
import type { Meta, Solutions } from "./data";
import { smooth } from "./motion";

export interface Orbit {
    /** Number of the solution that it belongs to. */
    solution: number;
    period: number;
    displacement: Float64Array;
    velocity: Float64Array;
    /** Displacements and velocities, those within contacts among them. */
    portrait: [Float64Array, Float64Array];
    /** Least and largest in each step, in their order in time. */
    acceleration: Float64Array;
    /** At the instants of the modes. */
    support: Float64Array;
    /** Least and largest in each step, in their order in time. */
    forces: Float64Array[];
    modes: Float64Array[];
    /** Common logarithms of the amplitudes of the harmonics of the acceleration. */
    spectrum: Float64Array;
}

/** Place in the list of the carried orbits of the one nearest to a solution on its branch; -1 where its branch has none. */
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

export function readOrbit(meta: Meta, solutions: Solutions, text: string, place: number): Orbit {
    const { offsets, length } = meta.orbits;
    const [begin, end] = [offsets[place] ?? 0, offsets[place + 1] ?? length];
    const bytes = bytesOf(text.slice((begin / 3) * 4, (end / 3) * 4));
    const view = new DataView(bytes.buffer);
    const count = (k: number): number => view.getUint16(2 * k, true);
    const [samples, steps, elements, ofMode, modes, harmonics, inside] = [count(0), count(1), count(2), count(3), count(4), count(5), count(6)];
    const repeated = (length: number, times: number): number[] => new Array<number>(times).fill(length);
    const lengths = [samples, samples, 2 * steps, ofMode, ...repeated(2 * steps, elements), ...repeated(ofMode, modes), harmonics, ...repeated(inside, 3)];
    const ranges = 14;
    let at = ranges + 8 * lengths.length;
    const series = lengths.map((length, k) => {
        const values = new Float64Array(length);
        at = readSeries(bytes, at, values, view.getFloat32(ranges + 8 * k, true), view.getFloat32(ranges + 8 * k + 4, true));
        return values;
    });
    const solution = meta.orbits.solutions[place] ?? 0;
    const none = new Float64Array(0);
    return {
        solution,
        period: meta.branches[solutions.branch[solution] ?? 0]?.period ?? 1,
        displacement: series[0] ?? none,
        velocity: series[1] ?? none,
        acceleration: series[2] ?? none,
        support: series[3] ?? none,
        forces: series.slice(4, 4 + elements),
        modes: series.slice(4 + elements, 4 + elements + modes),
        spectrum: series.at(-4) ?? none,
        portrait: portraitOf(series[0] ?? none, series[1] ?? none, series.slice(-3)),
    };
}

/** Parts of a step of a portrait that is drawn by cubics. */
const PARTS = 4;

/** Samples with those within contacts, each behind the sample whose number it has; away from contacts the motion is smooth, and cubics stand between samples. */
function portraitOf(displacement: Float64Array, velocity: Float64Array, inside: Float64Array[]): [Float64Array, Float64Array] {
    const [before, inDisplacement, inVelocity] = inside;
    const [x, y]: [number[], number[]] = [[], []];
    const struck = new Set(Array.from(before ?? [], Math.round));
    let next = 0;
    for (let k = 0; k < displacement.length; k++) {
        x.push(displacement[k] ?? NaN);
        y.push(velocity[k] ?? NaN);
        const isSmooth = !struck.has(k - 1) && !struck.has(k) && !struck.has(k + 1);
        for (let part = 1; isSmooth && part < PARTS; part++) {
            x.push(smooth(displacement, k + part / PARTS));
            y.push(smooth(velocity, k + part / PARTS));
        }
        for (; next < (before?.length ?? 0) && Math.round(before?.[next] ?? 0) <= k; next++) {
            x.push(inDisplacement?.[next] ?? NaN);
            y.push(inVelocity?.[next] ?? NaN);
        }
    }
    return [Float64Array.from(x), Float64Array.from(y)];
}

/** Fills a series from its second differences; returns where the next one begins. */
function readSeries(bytes: Uint8Array, begin: number, values: Float64Array, low: number, step: number): number {
    let at = begin;
    const next = (): number => {
        let [found, shift, byte] = [0, 0, 0x80];
        while (byte >= 0x80) {
            byte = bytes[at++] ?? 0;
            found |= (byte & 0x7f) << shift;
            shift += 7;
        }
        return found;
    };
    let [last, slope, zeros] = [0, 0, 0];
    for (let k = 0; k < values.length; k++) {
        if (zeros > 0) {
            zeros--;
        } else {
            const folded = next();
            zeros = folded === 0 ? next() : 0;
            slope += (folded >>> 1) ^ -(folded & 1);
        }
        last += slope;
        values[k] = low + step * last;
    }
    return at;
}
