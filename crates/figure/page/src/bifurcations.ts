// The table of bifurcations; a row jumps to its point.

import { BRANCH_POINT, FLIP, FOLD, GRAZING, NEIMARK_SACKER, type Meta, type Solutions } from "./data";
import { button, choice, element, panel, toggle } from "./dom";
import { digits } from "./format";
import { besideStable, eventNames } from "./marks";
import type { Store } from "./state";
import { Table } from "./table";
import { measureOf, parameterMeasure } from "./units";

const KINDS = [
    ["all", "all but grazing", FOLD | FLIP | NEIMARK_SACKER | BRANCH_POINT],
    ["fold", "fold", FOLD],
    ["flip", "flip", FLIP],
    ["neimark-sacker", "Neimark–Sacker", NEIMARK_SACKER],
    ["branch-point", "branch point", BRANCH_POINT],
    ["grazing", "grazing", GRAZING],
] as const;

/** Solutions with an event among the bits. */
export function eventsOf(solutions: Solutions, bits: number): number[] {
    const found: number[] = [];
    for (let k = 0; k < solutions.count; k++) {
        if (((solutions.flags[k] ?? 0) & bits) !== 0) {
            found.push(k);
        }
    }
    return found;
}

export function bifurcationTable(
    meta: Meta,
    solutions: Solutions,
    numbers: ReadonlyMap<number, number>,
    store: Store,
    jump: (solution: number) => void,
): HTMLElement {
    let bits: number = KINDS[0][2];
    let ofStable = false;
    const measure = () => parameterMeasure(meta, store.state.over);
    const displacement = measureOf(meta, "displacement", 0);
    const value = (k: number): number => solutions.parameter[k] ?? NaN;
    const head = element("span", {}, [""]);
    const table = new Table<number>(
        [
            { head: "no.", cell: (k) => String(numbers.get(k) ?? "–"), by: (k) => numbers.get(k) ?? k },
            {
                head: "at",
                cell: (k) =>
                    button(
                        place(measure().factor * value(k)),
                        `Go to this point, at ${measure().name} in ${measure().unit}`,
                        () => jump(k),
                    ),
                by: value,
            },
            {
                head: "event",
                cell: (k) => eventNames(solutions.flags[k] ?? 0),
                by: (k) => eventNames(solutions.flags[k] ?? 0),
            },
            {
                head: "of",
                cell: (k) => (besideStable(solutions, k) ? "stable" : "unstable"),
                by: (k) => (besideStable(solutions, k) ? 0 : 1),
            },
            {
                head: "branch",
                cell: (k) => String(meta.branches[solutions.branch[k] ?? 0]?.id ?? "–"),
                by: (k) => solutions.branch[k] ?? 0,
            },
            {
                head: displacement.unit,
                cell: (k) => digits(displacement.factor * (solutions.maxima.displacement[k] ?? NaN), 4),
                by: (k) => solutions.maxima.displacement[k] ?? NaN,
            },
        ],
        1,
        (row, solution) => {
            row.dataset["solution"] = String(solution);
            row.classList.toggle("current", solution === store.state.selected);
        },
        "Filter bifurcations, by any word or number in a row",
    );
    const fill = (): void => {
        const { hidden } = store.state;
        head.textContent = `at: ${measure().name} in ${measure().unit || "its unit"}.`;
        table.show(
            eventsOf(solutions, bits).filter(
                (k) => !hidden.has(solutions.branch[k] ?? 0) && (!ofStable || besideStable(solutions, k)),
            ),
        );
        if (table.count.textContent === "0") {
            table.count.textContent = "None on the branches drawn.";
        }
    };
    const kinds = choice(
        "Kind",
        KINDS.map(([kind, text]) => [kind, text] as const),
        (chosen) => {
            bits = KINDS.find(([kind]) => kind === chosen)?.[2] ?? bits;
            fill();
        },
    );
    const stable = toggle("of stable solutions", (on) => {
        ofStable = on;
        fill();
    });
    store.listen((state, changed) => {
        if (changed.has("hidden") || changed.has("over")) {
            fill();
        }
        if (changed.has("selected")) {
            for (const one of table.root.querySelectorAll("tr")) {
                one.classList.toggle("current", one.dataset["solution"] === String(state.selected));
            }
        }
    });
    fill();
    const note = element("p", { class: "note" }, [
        "No.: the number by which ",
        element("code", {}, [`hammerbeam run STUDY --from ${meta.folder || "RESULTS"}:NO`]),
        " starts at the point, also with changed parameters. ",
        head,
    ]);
    return panel("Bifurcations", "bifurcations", [
        element("div", { class: "controls" }, [kinds.root, stable.root, table.filter, table.count]),
        table.root,
        note,
    ]);
}

/** With five decimals, or six digits where that is more. */
function place(value: number): string {
    return Math.abs(value) >= 10 ? value.toFixed(5) : String(Number(value.toPrecision(7)));
}
