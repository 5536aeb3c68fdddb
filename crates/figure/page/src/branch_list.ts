// The list of branches, each with a switch.

import type { Branch, Meta, Solutions } from "./data";
import { button, element, panel } from "./dom";
import type { Store } from "./state";
import type { Theme } from "./theme";

export function branchList(meta: Meta, solutions: Solutions, store: Store, theme: Theme, shown: (branch: Branch) => void): HTMLElement {
    const boxes: HTMLInputElement[] = [];
    const swatches: HTMLElement[] = [];
    const rows: HTMLElement[] = [];
    // A hundredth of the range of the study, two at least.
    const decimals = Math.max(2, Math.ceil(2 - Math.log10(meta.range[1] - meta.range[0] || 1)));
    meta.branches.forEach((branch, place) => {
        const box = element("input", { type: "checkbox", "aria-label": `Draw branch ${branch.id}` });
        box.addEventListener("change", () => {
            const hidden = new Set(store.state.hidden);
            if (box.checked) {
                hidden.delete(place);
            } else {
                hidden.add(place);
            }
            store.update({ hidden });
        });
        const swatch = element("span", { class: "swatch" });
        const name = button(`${branch.id}`, `Show branch ${branch.id}. Its ends: ${branch.ends.join("; ")}`, () => shown(branch));
        const [low, high] = rangeOf(solutions, branch, decimals);
        const cells = [box, element("span", {}, [swatch, name]), String(branch.period), `${low}–${high}`, String(branch.count)];
        const row = element("tr", {}, cells.map((cell) => element("td", {}, [cell])));
        boxes.push(box);
        swatches.push(swatch);
        rows.push(row);
    });
    const update = (): void => {
        const { hidden, selected } = store.state;
        const current = selected < 0 ? -1 : (solutions.branch[selected] ?? -1);
        boxes.forEach((box, place) => (box.checked = !hidden.has(place)));
        rows.forEach((row, place) => row.classList.toggle("current", place === current));
    };
    const paint = (): void => swatches.forEach((swatch, place) => (swatch.style.background = theme.period(meta.branches[place]?.period ?? 1)));
    store.listen((_, changed) => {
        if (changed.has("hidden") || changed.has("selected")) {
            update();
        }
    });
    theme.listen(paint);
    update();
    paint();
    const hideAllBut = (keep: (branch: Branch) => boolean): void =>
        store.update({ hidden: new Set(meta.branches.map((branch, place) => (keep(branch) ? -1 : place)).filter((place) => place >= 0)) });
    const periods = [...new Set(meta.branches.map((branch) => branch.period))].sort((a, b) => a - b);
    const switches = [
        button("all", "Draw all branches", () => hideAllBut(() => true)),
        button("none", "Draw no branch", () => hideAllBut(() => false)),
        ...(periods.length > 1 ? periods.map((period) => button(`period ${period}`, `Draw branches of period ${period} alone`, () => hideAllBut((branch) => branch.period === period))) : []),
    ];
    const heads = ["", "branch", "period", "Hz", "solutions"].map((text) => element("th", { scope: "col" }, [text]));
    const table = element("table", {}, [element("thead", {}, [element("tr", {}, heads)]), element("tbody", {}, rows)]);
    return panel(`Branches (${meta.branches.length})`, "branches", [element("div", { class: "controls" }, switches), element("div", { class: "scroll", tabindex: "0" }, [table])]);
}

/** Ends of the frequency range of a branch, with so many decimals. */
function rangeOf(solutions: Solutions, branch: Branch, decimals: number): [string, string] {
    let [low, high] = [Infinity, -Infinity];
    for (let k = branch.first; k < branch.first + branch.count; k++) {
        const frequency = solutions.frequency[k] ?? NaN;
        low = Math.min(low, frequency);
        high = Math.max(high, frequency);
    }
    return branch.count === 0 ? ["–", "–"] : [low.toFixed(decimals), high.toFixed(decimals)];
}
