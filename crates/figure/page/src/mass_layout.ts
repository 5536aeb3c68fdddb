// Where masses along a line, their names and what joins them are drawn. All lengths in CSS pixels.

import type { Structure } from "./data";

type Link = Structure["links"][number];

export const WALL = 14;
/** Room of the walls to move in. */
export const EDGE = 16;
/** Size of a mass at most. */
const LARGEST = 44;
/** Share of the distance of masses that a mass takes at most. */
const SHARE = 0.45;
/** Least distance between two names. */
const BETWEEN = 6;
/** Characters of a name that is cut, at least. */
const LEAST_CHARACTERS = 6;

export interface Layout {
    /** Where each mass rests, from the left. */
    rest: number[];
    /** Distance of two masses at rest. */
    spacing: number;
    /** Size of a mass. */
    size: number;
    /** The largest displacement: two masses that move towards each other by it stay apart. */
    room: number;
}

export function layoutOf(count: number, width: number): Layout {
    const spacing = (width - 2 * (WALL + EDGE)) / (count + 1);
    const size = Math.min(LARGEST, SHARE * spacing);
    const rest = Array.from({ length: count }, (_, k) => WALL + EDGE + (k + 1) * spacing);
    return { rest, spacing, size, room: 0.45 * (spacing - size) };
}

/** The name of every so many masses, cut where it has no room; empty where there is none. */
export function namesOf(
    names: readonly string[],
    spacing: number,
    widthOf: (text: string) => number,
): string[] {
    for (let every = 1; every < names.length; every++) {
        const room = every * spacing - BETWEEN;
        const shown = names.map((name, k) => (k % every === 0 ? shortened(name, room, widthOf) : ""));
        if (shown.every((name, k) => k % every !== 0 || name !== null)) {
            return shown.map((name) => name ?? "");
        }
    }
    return names.map((name, k) => (k === 0 ? (shortened(name, names.length * spacing, widthOf) ?? "") : ""));
}

/**
 * A name, or as much of its beginning and its end as has room; null where that is too little to know it by.
 */
export function shortened(name: string, room: number, widthOf: (text: string) => number): string | null {
    if (widthOf(name) <= room) {
        return name;
    }
    const characters = [...name];
    for (let kept = characters.length - 1; kept >= LEAST_CHARACTERS; kept--) {
        const first = characters.slice(0, Math.ceil(kept / 2)).join("");
        const last = characters.slice(characters.length - Math.floor(kept / 2)).join("");
        const text = `${first}…${last}`;
        if (widthOf(text) <= room) {
            return text;
        }
    }
    return null;
}

export interface Joined extends Link {
    /**
     * Between neighbours, the first wall and the first mass, or the last mass and the last wall; from the
     * ground to a mass between others; between masses that are no neighbours.
     */
    kind: "direct" | "held" | "far";
    /** Places from left to right; -1 is the wall on the left, the number of masses that on the right. */
    from: number;
    to: number;
    /** Which one it is of those that lie beside or below each other, and how many those are. */
    level: number;
    levels: number;
}

/** Links by where they are drawn, each at a level of its own where it would cover another one. */
export function joinedOf(links: readonly Link[], count: number): Joined[] {
    const joined = links.map((link): Joined => {
        const [low, high] = link.ends.map((end) => end ?? -1).sort((a, b) => a - b) as [number, number];
        const isToTheRight = low === -1 && high === count - 1 && count > 1;
        const [from, to] = isToTheRight ? [high, count] : [low, high];
        const kind = to - from === 1 ? "direct" : low === -1 ? "held" : "far";
        return { ...link, kind, from, to, level: 0, levels: 1 };
    });
    const beside = (one: Joined): Joined[] =>
        joined.filter(({ from, to }) => from === one.from && to === one.to);
    for (const one of joined.filter(({ kind }) => kind !== "far")) {
        one.levels = beside(one).length;
        one.level = beside(one).indexOf(one);
    }
    // Each on the first level whose last link ends where it begins, or before.
    const ends: number[] = [];
    const far = joined.filter(({ kind }) => kind === "far").sort((a, b) => a.from - b.from || a.to - b.to);
    for (const one of far) {
        const free = ends.findIndex((end) => end <= one.from);
        one.level = free < 0 ? ends.length : free;
        ends[one.level] = one.to;
    }
    far.forEach((one) => (one.levels = ends.length));
    return joined;
}
