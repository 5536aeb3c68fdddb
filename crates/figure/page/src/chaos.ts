// Ranges of chaotic motion, and the stored motion that is nearest to a frequency.

import type { Meta } from "./data";
import type { State } from "./state";

/** Height (CSS pixels) of the strip above a chaotic range where a click always means the range. */
export const STRIP = 12;

/** Whether the diagram is over the frequency, as measured points and chaotic ranges are. */
export function isOverFrequency({ across, over }: Pick<State, "across" | "over">): boolean {
    return across === "parameter" && over === 0;
}

/** The chaotic range that holds a frequency, or lies no farther from it than `near` (Hz). */
export function rangeAt(meta: Meta, frequency: number, near: number): [number, number] | null {
    return meta.chaos.find(([low, high]) => frequency >= low - near && frequency <= high + near) ?? null;
}

/** Places of the sections of chaotic motions; of all motions where none is known to be chaotic. */
export function chaoticSections(meta: Meta): number[] {
    const all = meta.sections.map((_, place) => place);
    const chaotic = all.filter((place) => meta.sections[place]?.kind === "chaotic");
    return chaotic.length > 0 ? chaotic : all;
}

/**
 * Place of the section nearest to a frequency, the first of several; within a range if one lies there; -1
 * for none.
 */
export function nearestSection(meta: Meta, frequency: number, range: [number, number] | null): number {
    const away = (place: number): number => Math.abs((meta.sections[place]?.frequency ?? NaN) - frequency);
    const isWithin = (place: number): boolean =>
        range !== null &&
        (meta.sections[place]?.frequency ?? NaN) >= range[0] &&
        (meta.sections[place]?.frequency ?? NaN) <= range[1];
    const all = chaoticSections(meta);
    const within = all.filter(isWithin);
    return (within.length > 0 ? within : all).reduce(
        (best, place) => (best < 0 || away(place) < away(best) ? place : best),
        -1,
    );
}

/** Place of the chaotic motion before or behind a place. */
export function nextSection(meta: Meta, place: number, by: 1 | -1): number {
    const all = chaoticSections(meta);
    const found = by > 0 ? all.find((other) => other > place) : all.findLast((other) => other < place);
    return found ?? (by > 0 ? all[0] : all.at(-1)) ?? -1;
}
