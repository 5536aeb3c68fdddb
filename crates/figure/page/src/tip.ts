// What stands beside the pointer.

import { nearestSection } from "./chaos";
import type { Meta, Solutions } from "./data";
import { element } from "./dom";
import { digits, shortHertz } from "./format";
import { numbersOf } from "./numbers";
import { dotText } from "./overlay";
import type { Picked } from "./pick";
import type { State } from "./state";
import { MEASURES } from "./units";

/** Of the numbers of a solution those that are told beside the pointer. */
const WANTED = [
    "Frequency",
    "Branch",
    "Stability",
    "Event",
    "Max. displacement",
    "Max. acceleration",
    "Max. contact force",
    "Leading multiplier",
];

export function tipText(meta: Meta, solutions: Solutions, state: State, picked: Picked): Node[] {
    return rowsOf(meta, solutions, state, picked).map(([name, text]) =>
        element("div", {}, [element("b", {}, [name]), ` ${text}`]),
    );
}

function rowsOf(meta: Meta, solutions: Solutions, state: State, picked: Picked): [string, string][] {
    if ("solution" in picked) {
        return numbersOf(meta, solutions, picked.solution).filter(([name]) => WANTED.includes(name));
    }
    if ("dot" in picked) {
        return dotText(meta, picked.dot, state);
    }
    const section = meta.sections[nearestSection(meta, picked.frequency, picked.range)];
    const opens =
        section === undefined
            ? "no motion is stored"
            : `the Poincaré section at ${shortHertz(section.frequency, 6)}`;
    return [
        ["Chaotic motion", rangeText(picked.range)],
        ["Click", opens],
    ];
}

/** A range of the frequency, or a single one. */
export function rangeText([low, high]: [number, number]): string {
    const { factor } = MEASURES.frequency;
    return low === high ? shortHertz(low, 5) : `${digits(factor * low, 5)} to ${shortHertz(high, 5)}`;
}
