// The numbers of a solution in words.

import { MARGINAL, STABLE, type Meta, type Solutions } from "./data";
import { complex, digits, hertz, periodName } from "./format";
import { eventNames } from "./marks";
import { MEASURES, parameterMeasure } from "./units";

export function isStable(solutions: Solutions, solution: number): boolean {
    return ((solutions.flags[solution] ?? 0) & STABLE) !== 0;
}

/**
 * What is known of the stability of a solution: marginal where a multiplier is on the unit circle as well
 * as it is known.
 */
export function stabilityOf(solutions: Solutions, solution: number): string {
    const isMarginal = ((solutions.flags[solution] ?? 0) & MARGINAL) !== 0;
    return isMarginal ? "marginal" : isStable(solutions, solution) ? "stable" : "unstable";
}

/** Names and values of everything that is known of a solution. */
export function numbersOf(meta: Meta, solutions: Solutions, solution: number): [string, string][] {
    const branch = meta.branches[solutions.branch[solution] ?? 0];
    const value = (quantity: keyof Solutions["maxima"]): string => {
        const { factor, unit } = MEASURES[quantity];
        return `${digits(factor * (solutions.maxima[quantity][solution] ?? NaN), 6)} ${unit}`;
    };
    const [re, im] = [solutions.multiplierRe[solution] ?? NaN, solutions.multiplierIm[solution] ?? NaN];
    const events = eventNames(solutions.flags[solution] ?? 0);
    const over = branch?.over ?? 0;
    const { name, unit, factor } = parameterMeasure(meta, over);
    const parameter = solutions.parameter[solution] ?? NaN;
    const energy = solutions.energy[solution] ?? NaN;
    return [
        ["Frequency", hertz(solutions.frequency[solution] ?? NaN)],
        ...(over > 0
            ? [[name, `${digits(factor * parameter, 7)} ${unit}`] as [string, string]]
            : []),
        [
            "Branch",
            `${branch?.id ?? "–"}, ${periodName(branch?.period ?? 1)}, ` +
                `solution ${solution - (branch?.first ?? 0) + 1} of ${branch?.count ?? 0}`,
        ],
        ["Stability", stabilityOf(solutions, solution)],
        ...(events === "" ? [] : [["Event", events] as [string, string]]),
        ["Max. displacement", value("displacement")],
        ["Max. acceleration", value("acceleration")],
        ["Max. contact force", value("force")],
        ["Max. impact velocity", value("velocity")],
        ["Contacts per orbit period", String(solutions.contacts[solution] ?? 0)],
        ["Leading multiplier", `${complex(re, im)}, modulus ${digits(Math.hypot(re, im), 5)}`],
        ...(Number.isNaN(energy)
            ? []
            : [
                  [
                      "Energy at phase 0",
                      `${digits(MEASURES.energy.factor * energy, 6)} ${MEASURES.energy.unit}`,
                  ] as [string, string],
              ]),
    ];
}
