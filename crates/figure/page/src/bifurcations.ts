// The table of bifurcations; a row jumps to its point.

import { BRANCH_POINT, FLIP, FOLD, GRAZING, NEIMARK_SACKER, type Meta, type Solutions } from "./data";
import { button, choice, element, panel, toggle } from "./dom";
import { digits } from "./format";
import { besideStable, eventNames } from "./marks";
import type { Store } from "./state";

const KINDS = [
    ["all", "all but grazing", FOLD | FLIP | NEIMARK_SACKER | BRANCH_POINT],
    ["fold", "fold", FOLD],
    ["flip", "flip", FLIP],
    ["neimark-sacker", "Neimark–Sacker", NEIMARK_SACKER],
    ["branch-point", "branch point", BRANCH_POINT],
    ["grazing", "grazing", GRAZING],
] as const;

/** Rows that are made at a time. */
const ROWS = 150;

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

export function bifurcationTable(meta: Meta, solutions: Solutions, store: Store, jump: (solution: number) => void): HTMLElement {
    let bits: number = KINDS[0][2];
    let ofStable = false;
    let rows = ROWS;
    const body = element("tbody");
    const count = element("span", { class: "note" });
    const more = button("more rows", "Show more rows", () => {
        rows += ROWS;
        fill();
    });
    const row = (solution: number): HTMLElement => {
        const frequency = button((solutions.frequency[solution] ?? NaN).toFixed(5), "Go to this point", () => jump(solution));
        const displacement = digits(1e3 * (solutions.maxima.displacement[solution] ?? NaN), 4);
        const branch = meta.branches[solutions.branch[solution] ?? 0];
        const cells = [frequency, eventNames(solutions.flags[solution] ?? 0), String(branch?.id ?? "–"), displacement];
        const made = element("tr", { "data-solution": String(solution) }, cells.map((cell) => element("td", {}, [cell])));
        made.classList.toggle("current", solution === store.state.selected);
        return made;
    };
    const fill = (): void => {
        const { hidden } = store.state;
        const found = eventsOf(solutions, bits).filter((k) => !hidden.has(solutions.branch[k] ?? 0) && (!ofStable || besideStable(solutions, k)));
        found.sort((a, b) => (solutions.frequency[a] ?? 0) - (solutions.frequency[b] ?? 0));
        body.replaceChildren(...found.slice(0, rows).map(row));
        more.hidden = found.length <= rows;
        count.textContent = found.length === 0 ? "None on the branches drawn." : found.length > rows ? `${rows} of ${found.length}` : `${found.length}`;
    };
    const kinds = choice("Kind", KINDS.map(([value, text]) => [value, text] as const), (value) => {
        bits = KINDS.find(([kind]) => kind === value)?.[2] ?? bits;
        rows = ROWS;
        fill();
    });
    const stable = toggle("of stable solutions", (on) => {
        ofStable = on;
        rows = ROWS;
        fill();
    });
    store.listen((state, changed) => {
        if (changed.has("hidden")) {
            fill();
        }
        if (changed.has("selected")) {
            for (const one of body.querySelectorAll("tr")) {
                one.classList.toggle("current", one.dataset["solution"] === String(state.selected));
            }
        }
    });
    fill();
    const heads = ["Hz", "event", "branch", "mm"].map((text) => element("th", { scope: "col" }, [text]));
    const table = element("table", {}, [element("thead", {}, [element("tr", {}, heads)]), body]);
    return panel("Bifurcations", "bifurcations", [
        element("div", { class: "controls" }, [kinds.root, stable.root, count]),
        element("div", { class: "scroll", tabindex: "0" }, [table, more]),
    ]);
}
