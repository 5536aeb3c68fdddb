// Keys, and the list of them.

import { eventsOf } from "./bifurcations";
import { nextSection } from "./chaos";
import { FOLD, FLIP, NEIMARK_SACKER, BRANCH_POINT, type Branch, type Meta, type Solutions } from "./data";
import { element } from "./dom";
import type { Response } from "./response";
import type { Store } from "./state";
import type { Axis } from "./units";

export interface Actions {
    response: Response;
    /** Those that can be shown. */
    quantities: readonly Axis[];
    quantity: (quantity: Axis) => void;
    section: (place: number) => void;
    play: () => void;
    copyLink: () => void;
    tour: () => void;
    help: () => void;
}

const LIST: readonly [string, string][] = [
    ["← →", "one solution back or on along its branch (with Page Up, Page Down: 100)"],
    ["↑ ↓", "the branch before or behind in the list"],
    ["[ ]", "the bifurcation before or behind on the branch"],
    [", .", "the chaotic motion before or behind, with its Poincaré section"],
    ["+ −", "zoom in or out about the selected solution"],
    ["Shift and arrows", "move the view"],
    ["0", "everything"],
    ["Space", "play or pause the motion"],
    ["Q", "another quantity"],
    ["L", "logarithmic or linear"],
    ["M", "marks on or off"],
    ["N", "numbers of special points on or off"],
    ["D", "dark or light"],
    ["C", "copy a link to what is shown"],
    ["T", "a short tour of the page"],
    ["Esc", "no selection"],
    ["?", "this list"],
];

const POINTER: readonly [string, string][] = [
    [
        "Click",
        "the nearest solution; in a chaotic range, or on the strip above it, the nearest chaotic motion",
    ],
    ["Wheel", "zoom (with Shift: frequency alone; with Alt: vertical axis alone)"],
    ["Drag", "zoom into a box"],
    ["Shift and drag", "move the view; so does the right button, or a finger"],
    ["Two fingers", "zoom"],
    ["Double click", "everything"],
];

/** What scrolls a list. */
const SCROLLING: ReadonlySet<string> = new Set([
    "ArrowUp",
    "ArrowDown",
    "ArrowLeft",
    "ArrowRight",
    "PageUp",
    "PageDown",
    "Home",
    "End",
    " ",
]);

export function helpDialog(): HTMLDialogElement {
    const list = (rows: readonly [string, string][]): HTMLElement =>
        element(
            "dl",
            { class: "keys" },
            rows.flatMap(([key, text]) => [element("dt", {}, [key]), element("dd", {}, [text])]),
        );
    const close = element("form", { method: "dialog" }, [element("button", {}, ["Close"])]);
    return element("dialog", { "aria-label": "Keys" }, [
        element("h2", {}, ["Keys"]),
        list(LIST),
        element("h2", {}, ["Pointer"]),
        list(POINTER),
        close,
    ]);
}

export function listenToKeys(meta: Meta, solutions: Solutions, store: Store, actions: Actions): void {
    const bifurcations = eventsOf(solutions, FOLD | FLIP | NEIMARK_SACKER | BRANCH_POINT);
    const select = (selected: number): void => {
        store.update({ selected });
        if (selected >= 0) {
            actions.response.follow(selected);
        }
    };
    /** The first branch that is drawn, from a place in the list on, forwards or backwards. */
    const drawn = (from: number, by: 1 | -1): Branch | undefined => {
        const count = meta.branches.length;
        for (let k = 0; k < count; k++) {
            const place = (((from + k * by) % count) + count) % count;
            const branch = meta.branches[place];
            if (branch !== undefined && branch.count > 0 && !store.state.hidden.has(place)) {
                return branch;
            }
        }
        return undefined;
    };
    const step = (by: number): void => {
        const { selected, hidden } = store.state;
        const place = solutions.branch[Math.max(0, selected)] ?? 0;
        const branch = drawn(place, 1);
        if (branch !== undefined) {
            const isOn = selected >= 0 && !hidden.has(place);
            select(
                isOn
                    ? Math.min(branch.first + branch.count - 1, Math.max(branch.first, selected + by))
                    : branch.first,
            );
        }
    };
    const stepBranch = (by: 1 | -1): void => {
        const { selected } = store.state;
        const branch = drawn(selected < 0 ? 0 : (solutions.branch[selected] ?? 0) + by, by);
        if (branch !== undefined) {
            select(branch.first + (branch.count >> 1));
        }
    };
    const stepEvent = (by: 1 | -1): void => {
        const { selected, hidden } = store.state;
        const own = bifurcations.filter(
            (k) =>
                !hidden.has(solutions.branch[k] ?? 0) &&
                (selected < 0 || solutions.branch[k] === solutions.branch[selected]),
        );
        const found = by > 0 ? own.find((k) => k > selected) : own.findLast((k) => k < selected);
        if (found !== undefined) {
            select(found);
        }
    };
    const zoom = (factor: number): void => actions.response.zoomAboutSelected(factor);
    const plain: Record<string, () => void> = {
        ArrowLeft: () => step(-1),
        ArrowRight: () => step(1),
        PageUp: () => step(-100),
        PageDown: () => step(100),
        ArrowUp: () => stepBranch(-1),
        ArrowDown: () => stepBranch(1),
        "[": () => stepEvent(-1),
        "]": () => stepEvent(1),
        ",": () => actions.section(nextSection(meta, store.state.section, -1)),
        ".": () => actions.section(nextSection(meta, store.state.section, 1)),
        "+": () => zoom(0.6),
        "=": () => zoom(0.6),
        "-": () => zoom(1 / 0.6),
        "0": () => store.update({ view: null }),
        " ": actions.play,
        q: () =>
            actions.quantity(
                actions.quantities[
                    (actions.quantities.indexOf(store.state.quantity) + 1) % actions.quantities.length
                ] ?? "displacement",
            ),
        l: () => store.update({ log: !store.state.log, view: null }),
        n: () => store.update({ numbers: !store.state.numbers }),
        t: actions.tour,
        m: () => store.update({ marks: !store.state.marks }),
        d: () =>
            store.update({ theme: document.documentElement.dataset["theme"] === "dark" ? "light" : "dark" }),
        c: actions.copyLink,
        Escape: () => select(-1),
        "?": actions.help,
    };
    const shifted: Record<string, () => void> = {
        ArrowLeft: () => actions.response.pan([-0.1, 0]),
        ArrowRight: () => actions.response.pan([0.1, 0]),
        ArrowUp: () => actions.response.pan([0, 0.1]),
        ArrowDown: () => actions.response.pan([0, -0.1]),
    };
    // Keys scroll a list that was reached by Tab, not one that was clicked into.
    let byTab = false;
    document.addEventListener("pointerdown", () => (byTab = false), true);
    document.addEventListener("keydown", (event) => {
        byTab ||= event.key === "Tab";
        const target = event.target instanceof HTMLElement ? event.target : null;
        const scrolls = byTab && SCROLLING.has(event.key) && target?.matches(".scroll") === true;
        const writes = target?.closest("select, input:not([type=checkbox]), dialog") ?? null;
        const presses = event.key === " " && target?.closest("button, input") !== null;
        if (event.ctrlKey || event.metaKey || event.altKey || writes !== null || scrolls || presses) {
            return;
        }
        const act =
            (event.shiftKey ? shifted[event.key] : undefined) ??
            plain[event.key] ??
            plain[event.key.toLowerCase()];
        if (act !== undefined) {
            event.preventDefault();
            act();
        }
    });
}
