// What axes can show, with the units that suit the values of this page: 73 nm, 64.6 kHz.

import type { Meta, Quantity, Solutions } from "./data";

/**
 * What an axis of the response diagram can show. `parameter` is that along which branches were followed:
 * mostly the frequency.
 */
export type Axis = "parameter" | Quantity | "multiplier" | "contacts" | "energy" | OutputAxis;

/** One of `Meta.outputs`, by its number from 1. */
export type OutputAxis = `output-${number}`;

export interface Measure {
    /** In a list. */
    name: string;
    /** On an axis, without the unit. */
    title: string;
    unit: string;
    /** From SI to the unit. */
    factor: number;
}

const PREFIXES: readonly (readonly [string, number])[] = [
    ["G", 1e9],
    ["M", 1e6],
    ["k", 1e3],
    ["", 1],
    ["m", 1e-3],
    ["µ", 1e-6],
    ["n", 1e-9],
    ["p", 1e-12],
];

/** The measures of this page; `chooseUnits` fits their units to its values. */
export const MEASURES: Record<Quantity | "multiplier" | "contacts" | "energy" | "frequency", Measure> = {
    displacement: { name: "displacement", title: "Displacement max |y|", unit: "mm", factor: 1e3 },
    acceleration: { name: "acceleration", title: "Acceleration max |ÿ|", unit: "m/s²", factor: 1 },
    force: { name: "contact force", title: "Largest contact force", unit: "N", factor: 1 },
    velocity: { name: "impact velocity", title: "Largest impact velocity", unit: "m/s", factor: 1 },
    multiplier: { name: "largest multiplier", title: "Largest multiplier |μ|", unit: "", factor: 1 },
    contacts: { name: "contacts per period", title: "Contacts per orbit period", unit: "", factor: 1 },
    energy: { name: "energy", title: "Energy of the structure at phase 0", unit: "J", factor: 1 },
    frequency: { name: "frequency", title: "Excitation frequency", unit: "Hz", factor: 1 },
};

/** The outputs of this page, in their order. */
export const OUTPUTS: Measure[] = [];

/** Whether an axis shows an output. */
export function isOutput(axis: Axis): axis is OutputAxis {
    return axis.startsWith("output-");
}

/** The place of an output in the lists of outputs. */
export function outputOf(axis: OutputAxis): number {
    return Number(axis.slice("output-".length)) - 1;
}

/** Units that nobody reads in thousands. */
const WITHOUT_KILO: readonly string[] = ["m", "m/s", "m/s²", "rad"];

/**
 * The prefix of a unit that suits values up to a largest one: the largest prefix at which that is not small.
 *
 * * `least`: the smallest number for it that is easily read.
 */
export function prefixFor(largest: number, least = 0.2): readonly [string, number] {
    const suits = ([prefix, size]: readonly [string, number]): boolean =>
        largest / size >= (size > 1 ? 1 : prefix === "" ? least : 0.2);
    return (Number.isFinite(largest) && largest > 0 ? PREFIXES.find(suits) : undefined) ?? ["", 1];
}

/** The largest finite value of a column. */
function largestOf(values: ArrayLike<number>): number {
    let most = 0;
    for (let k = 0; k < values.length; k++) {
        const value = Math.abs(values[k] ?? 0);
        most = value > most && value < Infinity ? value : most;
    }
    return most;
}

/** Fits the units to what the page holds. */
export function chooseUnits(meta: Meta, solutions: Solutions): void {
    const set = (
        key: keyof typeof MEASURES,
        [prefix, size]: readonly [string, number],
        unit: string,
    ): void => {
        MEASURES[key] = { ...MEASURES[key], unit: `${prefix}${unit}`, factor: 1 / size };
    };
    const maxima = solutions.maxima;
    const measured = (quantity: Quantity): number[] =>
        meta.measured
            .filter((one) => one.quantity === quantity)
            .flatMap(({ points }) => points.map(({ shifted }) => shifted[1] ?? 0));
    const largest = (quantity: Quantity): number =>
        Math.max(largestOf(maxima[quantity]), largestOf(measured(quantity)));
    const motions = largestOf(meta.motions.map(({ displacement }) => displacement ?? 0));
    const displacement = Math.max(largest("displacement"), motions);
    if (displacement > 0) {
        set("displacement", prefixFor(displacement), "m");
    }
    OUTPUTS.splice(
        0,
        OUTPUTS.length,
        ...meta.outputs.map(({ title, unit }, k) => {
            const most = largestOf(solutions.outputs[k] ?? []);
            const [prefix, size] = prefixFor(WITHOUT_KILO.includes(unit) ? Math.min(most, 999) : most);
            return { name: title, title, unit: `${prefix}${unit}`, factor: 1 / size };
        }),
    );
    set("force", prefixFor(largest("force")), "N");
    set("energy", prefixFor(largestOf(solutions.energy)), "J");
    // Nobody reads km/s² or km/s.
    set("acceleration", prefixFor(Math.min(largest("acceleration"), 999)), "m/s²");
    set("velocity", prefixFor(Math.min(largest("velocity"), 999)), "m/s");
    const highest = meta.range[1];
    set(
        "frequency",
        highest >= 1e4 ? prefixFor(highest) : highest < 0.01 ? prefixFor(highest) : ["", 1],
        "Hz",
    );
}

/** The label of an axis: what and in which unit. */
export function axisLabel({ title, unit }: Measure): string {
    return unit === "" ? title : `${title} (${unit})`;
}

/** What the parameter of a set of branches measures: 0 is the frequency. */
export function parameterMeasure(meta: Meta, over: number): Measure {
    const parameter = meta.parameters[over - 1];
    return parameter === undefined
        ? MEASURES.frequency
        : { name: parameter.title, title: parameter.title, unit: parameter.unit, factor: parameter.factor };
}

export function measureOf(meta: Meta, axis: Axis, over: number): Measure {
    if (axis === "parameter") {
        return parameterMeasure(meta, over);
    }
    return isOutput(axis) ? (OUTPUTS[outputOf(axis)] ?? MEASURES.displacement) : MEASURES[axis];
}
