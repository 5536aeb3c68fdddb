// The list of branches, each with a switch.

import type { Branch, Meta, Solutions } from "./data";
import { button, element, panel } from "./dom";
import { periodName } from "./format";
import type { Store } from "./state";
import { Table } from "./table";
import type { Theme } from "./theme";
import { parameterMeasure } from "./units";

interface Listed extends Branch {
    place: number;
    range: [number, number];
    box: HTMLInputElement;
    swatch: HTMLElement;
}

export function branchList(
    meta: Meta,
    solutions: Solutions,
    store: Store,
    theme: Theme,
    shown: (branch: Branch) => void,
): HTMLElement {
    const listed = meta.branches.map((branch, place): Listed => {
        const box = element("input", { type: "checkbox", "aria-label": `Draw branch ${branch.id}` });
        box.addEventListener("change", () => {
            const hidden = new Set(store.state.hidden);
            box.checked ? hidden.delete(place) : hidden.add(place);
            store.update({ hidden });
        });
        return {
            ...branch,
            place,
            range: rangeOf(solutions, branch),
            box,
            swatch: element("span", { class: "swatch" }),
        };
    });
    const name = (branch: Listed): Node =>
        element("span", {}, [
            branch.swatch,
            button(`${branch.id}`, `Show branch ${branch.id}. Its ends: ${branch.ends.join("; ")}`, () =>
                shown(branch),
            ),
        ]);
    const ends = ({ count, range, over }: Listed): string => {
        const { factor } = parameterMeasure(meta, over);
        return count === 0
            ? "–"
            : range.map((value) => decimal(factor * value, factor * spanOf(meta, listed, over))).join("–");
    };
    const made = new Map<HTMLElement, number>();
    const table = new Table<Listed>(
        [
            { head: "", cell: ({ box }) => box },
            { head: "branch", cell: name, by: ({ id }) => id },
            { head: "solutions", cell: ({ period }) => periodName(period), by: ({ period }) => period },
            { head: "from–to", cell: ends, by: ({ range }) => range[0] },
            { head: "points", cell: ({ count }) => String(count), by: ({ count }) => count },
        ],
        1,
        (row, { place }) => {
            made.set(row, place);
            row.dataset["branch"] = String(place);
            row.classList.toggle("current", place === currentOf());
        },
        "Filter branches, by number or kind: 1/2",
    );
    const currentOf = (): number =>
        store.state.selected < 0 ? -1 : (solutions.branch[store.state.selected] ?? -1);
    const update = (): void => {
        listed.forEach(({ box, place }) => (box.checked = !store.state.hidden.has(place)));
        made.forEach((place, row) => row.classList.toggle("current", place === currentOf()));
    };
    const paint = (): void =>
        listed.forEach(({ swatch, period }) => (swatch.style.background = theme.period(period)));
    const own = (): Listed[] => listed.filter(({ over }) => over === store.state.over);
    const hideAllBut = (keep: (branch: Listed) => boolean): void =>
        store.update({
            hidden: new Set(
                listed
                    .filter((branch) => branch.over !== store.state.over || !keep(branch))
                    .map(({ place }) => place),
            ),
        });
    const switches = element("div", { class: "controls" });
    const fill = (): void => {
        const periods = [...new Set(own().map(({ period }) => period))].sort((a, b) => a - b);
        const single = periods.map((period) =>
            button(periodName(period), `Draw ${periodName(period)} solutions alone`, () =>
                hideAllBut((branch) => branch.period === period),
            ),
        );
        switches.replaceChildren(
            button("all", "Draw all branches", () => hideAllBut(() => true)),
            button("none", "Draw no branch", () => hideAllBut(() => false)),
            ...(periods.length > 1 ? single : []),
            table.filter,
        );
        made.clear();
        table.show(own());
        update();
    };
    store.listen((_, changed) => {
        if (changed.has("over")) {
            fill();
        } else if (changed.has("hidden") || changed.has("selected")) {
            update();
        }
    });
    theme.listen(paint);
    fill();
    paint();
    return panel(`Branches (${meta.branches.length})`, "branches", [switches, table.root]);
}

/** Ends of the range of the parameter of a branch. */
function rangeOf({ parameter }: Solutions, branch: Branch): [number, number] {
    let [low, high] = [Infinity, -Infinity];
    for (let k = branch.first; k < branch.first + branch.count; k++) {
        const value = parameter[k] ?? NaN;
        low = Math.min(low, value);
        high = Math.max(high, value);
    }
    return [low, high];
}

/** Width of the range of all branches over a parameter. */
function spanOf(meta: Meta, listed: readonly Listed[], over: number): number {
    const own = listed.filter((branch) => branch.over === over && branch.count > 0);
    return over === 0
        ? meta.range[1] - meta.range[0]
        : Math.max(...own.map(({ range }) => range[1])) - Math.min(...own.map(({ range }) => range[0]));
}

/** With so many decimals that a hundredth of a range is told, two at least. */
function decimal(value: number, span: number): string {
    return value.toFixed(Math.min(12, Math.max(2, Math.ceil(2 - Math.log10(span || 1)))));
}
