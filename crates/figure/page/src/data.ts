// What the page is given: what is small as JSON, solutions as columns (see columns.rs of the figure crate).

import { bytesOf } from "./base64";
import { Unpacker } from "./unpack";

export interface Look {
    periods: string[];
    /** Strokes across the lines of each of these periods. */
    strokes: number[];
    ink: string;
    pale: string;
    grid: string;
    paper: string;
    panel: string;
    shade: string;
}

export interface Branch {
    id: number;
    period: number;
    ends: [string, string];
    /** Number of its first solution over all branches end to end. */
    first: number;
    count: number;
    /**
     * The parameter along which it was followed: 0 for the frequency, else the number of one of
     * `parameters`, from 1.
     */
    over: number;
}

/** A parameter other than the frequency over which there are branches. */
export interface Parameter {
    title: string;
    /** Its SI unit. */
    si: string;
    /** The unit that suits its values, and the factor from SI to it. */
    unit: string;
    factor: number;
    /** The frequency that its branches are at (Hz). */
    frequency: number;
}

/** A number that was read off each solution. */
export interface Output {
    title: string;
    /** Its SI unit without prefix. */
    unit: string;
}

export interface Place {
    name: string;
    at: number;
    shape: number[];
    /** Displacement per unit displacement of each support that moves. */
    support: number[];
}

export interface Stop {
    name: string;
    element: number;
    place: number;
    other: number | null;
    /** Number of the moving support that it rides on. */
    rides: number | null;
    levels: { level: number; above: boolean }[];
}

/** A mesh in space. */
export interface Mesh {
    nodes: [number, number, number][];
    /** Displacement of each node along x, y and z in each mode, and per unit displacement of each support. */
    shapes: [number[], number[], number[]][];
    support: [number[], number[], number[]][];
    lines: [number, number][];
    /** The node of each place of the structure. */
    places: (number | null)[];
}

export interface Structure {
    beam: boolean;
    places: Place[];
    stops: Stop[];
    links: { ends: [number | null, number | null]; damper: boolean }[];
    eigenfrequencies: number[];
    /** Names of the supports that move. */
    supports: string[];
    /** Number of the support that moves the ground. */
    ground: number | null;
    /** The mesh that is drawn, where it is known. */
    mesh: Mesh | null;
}

export type MotionKind = "periodic" | "quasi-periodic" | "chaotic" | "doubtful";

export interface Section {
    frequency: number;
    /** Where the motion is from, in words. */
    origin: string;
    kind: MotionKind | null;
    exponent: [number | null, number | null] | null;
    dimension: number | null;
    /** Whether a point is the displacement with that one period later, in place of the velocity. */
    next: boolean;
    /** How many points are stored; not all of them may be carried. */
    count: number;
    /** Least and largest value of each coordinate; null where there is no point. */
    x: [number | null, number | null];
    y: [number | null, number | null];
    /** The points as base64: pairs of u16, from the least to the largest value. */
    points: string;
}

export interface MeasuredPoint {
    origin: string;
    motion: "periodic" | "aperiodic" | "unknown";
    period: number | null;
    /** Frequency and value, as measured and as shifted by the comparison; null where not finite. */
    measured: [number | null, number | null];
    shifted: [number | null, number | null];
    verdict: string;
}

export interface Measured {
    name: string;
    quantity: Quantity;
    /** What has to be known before points and branches are compared. */
    note: string;
    points: MeasuredPoint[];
}

/** A printed figure. */
export interface Figure {
    name: string;
    heading: string;
    description: string;
}

export interface Motion {
    frequency: number;
    displacement: number | null;
    kind: MotionKind;
}

export interface Meta {
    title: string;
    point: string;
    range: [number, number];
    notice: string;
    branches: Branch[];
    parameters: Parameter[];
    outputs: Output[];
    /** Name of the results folder, for commands. */
    folder: string;
    /** Solutions whose orbits are carried, and the lengths of their records in bytes. */
    orbits: { solutions: number[]; lengths: number[] };
    /** Of how many solutions, and how many of one of them at most, those that are not carried included. */
    multipliers: { solutions: number; most: number };
    structure: Structure | null;
    motions: Motion[];
    chaos: [number, number][];
    sections: Section[];
    measured: Measured[];
    /**
     * Printed figures; the names of those that had no room, and of those that could not be drawn with the
     * reason.
     */
    figures: { carried: Figure[]; noRoom: string[]; refused: [string, string][] };
    look: { light: Look; dark: Look };
}

export type Quantity = "displacement" | "acceleration" | "force" | "velocity";

/** Bits of the flags of a solution. */
export const STABLE = 1,
    FOLD = 2,
    FLIP = 4,
    NEIMARK_SACKER = 8,
    BRANCH_POINT = 16,
    GRAZING = 32,
    MARGINAL = 64;

export interface Solutions {
    count: number;
    /** Excitation frequency (Hz). */
    frequency: Float64Array;
    /** The parameter along which the branch of a solution was followed; for most the frequency. */
    parameter: Float64Array;
    maxima: Record<Quantity, Float32Array>;
    multiplierRe: Float32Array;
    multiplierIm: Float32Array;
    /** Mechanical energy of the structure at phase 0 (J); NaN where it is not known. */
    energy: Float32Array;
    contacts: Uint32Array;
    /** Those of `Meta.outputs`, in their order; NaN where there is none. */
    outputs: Float32Array[];
    flags: Uint32Array;
    /** Place of the branch of each solution in the list of branches. */
    branch: Uint16Array;
}

function textOf(id: string): string {
    return document.getElementById(id)?.textContent ?? "";
}

export function readMeta(): Meta {
    return JSON.parse(textOf("meta")) as Meta;
}

/** The deflated columns of solutions in base64. */
export function solutionText(): string {
    return textOf("solutions");
}

/** Solutions from their columns (see columns.rs of the figure crate). */
export function readSolutions(
    { branches, outputs: named }: Pick<Meta, "branches" | "outputs">,
    bytes: Uint8Array<ArrayBuffer>,
): Solutions {
    const count = branches.reduce((sum, branch) => sum + branch.count, 0);
    const others = branches.reduce((sum, branch) => sum + (branch.over > 0 ? branch.count : 0), 0);
    const columns = new Unpacker(bytes);
    const frequency = columns.double(count);
    // Branches over other parameters come last.
    const parameter = others === 0 ? frequency : frequency.slice();
    parameter.set(columns.double(others), count - others);
    const single = (): Float32Array => columns.single(count);
    const maxima = { displacement: single(), acceleration: single(), force: single(), velocity: single() };
    const [multiplierRe, multiplierIm, energy] = [single(), single(), single()];
    const [contacts, flags] = [columns.whole(count, 2), columns.whole(count, 2)];
    const outputs = named.map(single);
    const branch = new Uint16Array(count);
    branches.forEach((of, place) => branch.fill(place, of.first, of.first + of.count));
    return {
        count,
        frequency,
        parameter,
        maxima,
        multiplierRe,
        multiplierIm,
        energy,
        contacts,
        outputs,
        flags,
        branch,
    };
}

/** The multipliers of all solutions, deflated, in base64. */
export function multiplierText(): string {
    return textOf("floquet");
}

/** The printed figures as SVG documents, in the order of their list. */
export function readFigures(): string[] {
    return JSON.parse(textOf("drawings")) as string[];
}

/** The points of a section. */
export function readSection({ x, y, points }: Section): [number, number][] {
    const bytes = bytesOf(points);
    const steps = new Uint16Array(bytes.buffer, 0, bytes.length >> 1);
    const value = ([low, high]: [number | null, number | null], step: number): number =>
        (low ?? NaN) + ((high ?? NaN) - (low ?? NaN)) * (step / 65535);
    return Array.from({ length: steps.length >> 1 }, (_, k) => [
        value(x, steps[2 * k] ?? 0),
        value(y, steps[2 * k + 1] ?? 0),
    ]);
}

/** The base64 text of all orbits. */
export function orbitText(): string {
    return textOf("orbits");
}
