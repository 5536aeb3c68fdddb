// Puts the page together.

import { Address } from "./address";
import { bifurcationTable } from "./bifurcations";
import { branchList } from "./branch_list";
import { controls } from "./controls";
import { Curves } from "./curves";
import { readMeta, readSolutions, type Quantity } from "./data";
import { button, element } from "./dom";
import { figurePanel } from "./figures";
import { digits } from "./format";
import { fromHash, toHash } from "./hash";
import { helpDialog, listenToKeys } from "./keys";
import { legend } from "./legend";
import type { Multiplier } from "./multiplier_table";
import type { Orbit } from "./orbit";
import { Response } from "./response";
import { sectionPanel } from "./sections";
import { SolutionView } from "./solution_view";
import { Store, type State } from "./state";
import { Theme } from "./theme";

const meta = readMeta();
const solutions = readSolutions(meta.branches);
const curves = new Curves(solutions);
const quantities = curves.present(meta.measured);
const stateOf = (hash: string): State => fromHash(hash, meta, quantities, (quantity) => curves.spansMuch(quantity));
const store = new Store(stateOf(location.hash));
const theme = new Theme(meta, store);

const page = document.getElementById("page") ?? document.body;
const help = helpDialog();
const said = element("p", { class: "note said", role: "status" });
const view = new SolutionView(meta, solutions, store, theme);
const diagram = element("div", { class: "diagram" });
const zoom = (factor: number): void => response.zoomAboutSelected(factor);
const whole = (): void => store.update({ view: null });
/** Another quantity, with all of it seen on the scale that suits it. */
const show = (quantity: Quantity): void => store.update({ quantity, log: curves.spansMuch(quantity), view: null });
const showHelp = (): void => help.showModal();

/** Says something for some seconds. */
function say(...words: (string | Node)[]): void {
    window.clearTimeout(saying);
    said.replaceChildren(...words);
    saying = window.setTimeout(() => said.replaceChildren(), 6000);
}
let saying = 0;

/** Copies the address of what is shown; where the clipboard is closed it says where the address stands. */
async function copyLink(): Promise<void> {
    address.write();
    try {
        await navigator.clipboard.writeText(location.href);
        say("The link is copied.");
    } catch {
        say("The address of this page is the link.");
    }
}

const copy = (): void => void copyLink();
const counted = (count: number, one: string, several: string): string => `${count} ${count === 1 ? one : several}`;
const subtitle = `${counted(meta.branches.length, "branch", "branches")}, ${counted(solutions.count, "solution", "solutions")}, ${meta.range[0]} to ${meta.range[1]} Hz${meta.point === "" ? "" : `; response of ${meta.point}`}`;
page.append(
    element("header", {}, [element("h1", {}, [meta.title || "Results"]), element("p", {}, [subtitle])]),
    ...(meta.notice === "" ? [] : [element("p", { class: "notice", role: "alert" }, [meta.notice])]),
    controls(meta, quantities, store, { quantity: show, whole, zoom, copyLink: copy, help: showHelp }),
    said,
    diagram,
);
const lists = element("div", { class: "lists" });
/** Opens the section at a place of their list; what the reader looks at stays where it is. */
const openSection = (place: number): void => {
    if (place < 0) {
        return;
    }
    store.update({ section: place });
    const panel = document.getElementById("section");
    const box = panel?.getBoundingClientRect();
    if (panel && box && (box.top > window.innerHeight - 200 || box.bottom < 100)) {
        const go = button("Go to it", "Scroll to the Poincaré section", () => {
            panel.scrollIntoView({ block: "nearest" });
            said.replaceChildren();
        });
        say(`The Poincaré section at ${digits(meta.sections[place]?.frequency ?? NaN, 6)} Hz is open.`, go);
    }
};
const response = new Response(meta, solutions, curves, store, theme, openSection, diagram);
const jump = (solution: number): void => {
    store.update({ selected: solution });
    response.show(solution, 0.05);
};
lists.append(
    branchList(meta, solutions, store, theme, (branch) => store.update({ selected: branch.first + (branch.count >> 1) })),
    bifurcationTable(meta, solutions, store, jump),
    ...[sectionPanel(meta, store, theme, openSection, (range) => response.showRange(range))].filter((part) => part !== null),
);
const notes = [...new Set(meta.measured.map((series) => series.note))].filter((note) => note !== "");
page.append(
    legend(meta, solutions, store, theme),
    ...notes.map((note) => element("p", { class: "note" }, [`Measured points: ${note}`])),
    view.root,
    lists,
    ...[figurePanel(meta)].filter((part) => part !== null),
    help,
);
if (solutions.count === 0) {
    diagram.prepend(element("p", { class: "notice" }, ["No periodic solution is stored."]));
}
view.show();
listenToKeys(meta, solutions, store, { response, quantities, quantity: show, section: openSection, play: () => view.animation.toggle(), copyLink: copy, help: showHelp });

const address = new Address(
    () => toHash(store.state, meta, solutions),
    (hash) => store.update(stateOf(hash)),
);
store.listen(() => address.plan());

// For tests and benchmarks.
declare global {
    interface Window {
        hammerbeam: {
            redraw: () => void;
            zoom: (factor: number) => void;
            placeOf: (solution: number) => [number, number];
            pointAt: (frequency: number, value: number) => [number, number];
            state: () => State;
            orbit: () => Orbit | null;
            unitCircle: () => [across: number, up: number];
            multipliersOf: (solution: number) => Multiplier[];
        };
    }
}
window.hammerbeam = {
    redraw: () => response.redraw(),
    zoom: (factor) => response.zoom([factor, factor]),
    placeOf: (solution) => response.placeOf(solution),
    pointAt: (frequency, value) => response.pointAt(frequency, value),
    state: () => store.state,
    orbit: () => view.orbit,
    unitCircle: () => view.unitCircle(),
    multipliersOf: (solution) => view.multipliersOf(solution),
};
