// Puts the page together.

import { Address } from "./address";
import { bifurcationTable } from "./bifurcations";
import { branchList } from "./branch_list";
import { controls, type Ending } from "./controls";
import { Curves } from "./curves";
import { multiplierText, readMeta, readSolutions, solutionText } from "./data";
import { element } from "./dom";
import { save as saveDiagram } from "./export";
import { figurePanel } from "./figures";
import { shortHertz } from "./format";
import { firstSolution } from "./first";
import { fromHash, toHash } from "./hash";
import { helpDialog, listenToKeys } from "./keys";
import { legend } from "./legend";
import { eventNumbers, markedSolutions } from "./marks";
import { MultiplierTable } from "./multiplier_table";
import { Others } from "./others";
import { Response } from "./response";
import { Saying } from "./saying";
import { sectionPanel } from "./sections";
import { SolutionView } from "./solution_view";
import { Store, type State } from "./state";
import { forTests } from "./testing";
import { Theme } from "./theme";
import { startTour } from "./tour";
import { chooseUnits, MEASURES, type Axis } from "./units";
import { inflated } from "./unpack";

/** Makes the page from what it carries. */
async function start(): Promise<void> {
    const meta = readMeta();
    const solutions = readSolutions(meta, await inflated(solutionText()));
    chooseUnits(meta, solutions);
    const curves = new Curves(meta, solutions);
    const quantities = curves.present(meta.measured);
    const openings = {
        quantities,
        suits: (quantity: Axis, over: number) => curves.spansMuch(quantity, over),
        first: firstSolution(meta, solutions),
    };
    const stateOf = (hash: string): State => fromHash(hash, meta, openings);
    const store = new Store(stateOf(location.hash));
    const theme = new Theme(meta, store);
    const saying = new Saying();
    const [marked, numbers] = [markedSolutions(solutions), eventNumbers(meta, solutions)];

    const page = document.getElementById("page") ?? document.body;
    const help = helpDialog();
    const diagram = element("div", { class: "diagram" });
    const others = new Others(meta, saying, () => {
        shown.fill();
        response.plan();
    });
    /** Opens the section at a place of their list; what the reader looks at stays where it is. */
    const openSection = (place: number): void => {
        if (place >= 0) {
            store.update({ section: place });
            saying.pointTo(
                "section",
                `The Poincaré section at ${shortHertz(meta.sections[place]?.frequency ?? NaN, 6)} is open.`,
            );
        }
    };
    const response = new Response(
        meta,
        solutions,
        curves,
        store,
        theme,
        { marked, numbers, compared: others.list },
        openSection,
        diagram,
    );
    const shown = legend({ meta, solutions, marked, compared: others.list, theme }, store);
    others.takeDropsOn(diagram);

    const view = new SolutionView(
        meta,
        solutions,
        store,
        theme,
        numbers,
        (text) => void saying.copy(text, "The command is copied."),
    );
    const address = new Address(
        () => toHash(store.state, meta, solutions),
        (hash) => store.update(stateOf(hash)),
    );
    store.listen(() => address.plan());
    const copyLink = (): void => {
        address.write();
        void saying.copy(location.href, "The link is copied.", "The address of this page is the link.");
    };
    /** Another quantity, with all of it seen on the scale that suits it. */
    const quantity = (chosen: Axis): void =>
        store.update({ quantity: chosen, log: curves.spansMuch(chosen, store.state.over), view: null });
    const over = (chosen: number): void => {
        const hidden = new Set(
            meta.branches.flatMap((branch, place) => (branch.over === chosen ? [] : [place])),
        );
        const branch = meta.branches.find((one) => one.over === chosen && one.count > 0);
        const selected =
            chosen === 0 || branch === undefined ? openings.first : branch.first + (branch.count >> 1);
        store.update({
            over: chosen,
            across: "parameter",
            hidden,
            view: null,
            selected,
            log: curves.spansMuch(store.state.quantity, chosen),
        });
    };
    const showHelp = (): void => help.showModal();
    const save = (ending: Ending): void =>
        void saveDiagram(response.frame, response.scene(), ending, {
            meta,
            solutions,
            marked,
            compared: others.list,
            theme,
        });
    const jump = (solution: number): void => {
        store.update({ selected: solution });
        response.show(solution, 0.05);
    };

    const notes = [...new Set(meta.measured.map((series) => series.note))].filter((note) => note !== "");
    const middle = (branch: { first: number; count: number }): void =>
        store.update({ selected: branch.first + (branch.count >> 1) });
    page.append(
        element("header", {}, [element("h1", {}, [meta.title || "Results"]), element("p", {}, [subtitle()])]),
        ...(meta.notice === "" ? [] : [element("p", { class: "notice", role: "alert" }, [meta.notice])]),
        controls(meta, quantities, store, {
            quantity,
            across: (across) => store.update({ across, view: null }),
            over,
            whole: () => store.update({ view: null }),
            zoom: (factor) => response.zoomAboutSelected(factor),
            save,
            compare: (files) => void others.open(files),
            copyLink,
            tour: startTour,
            help: showHelp,
        }),
        saying.root,
        diagram,
        shown.root,
        ...notes.map((note) => element("p", { class: "note" }, [`Measured points: ${note}`])),
        view.root,
        element("div", { class: "lists" }, [
            branchList(meta, solutions, store, theme, middle),
            bifurcationTable(meta, solutions, numbers, store, jump),
            ...[sectionPanel(meta, store, theme, openSection, (range) => response.showRange(range))].filter(
                (part) => part !== null,
            ),
        ]),
        ...[figurePanel(meta)].filter((part) => part !== null),
        help,
    );
    if (solutions.count === 0) {
        diagram.prepend(element("p", { class: "notice" }, ["No periodic solution is stored."]));
    }
    view.show();
    listenToKeys(meta, solutions, store, {
        response,
        quantities,
        quantity,
        section: openSection,
        play: () => view.animation.toggle(),
        copyLink,
        tour: startTour,
        help: showHelp,
    });
    forTests({
        response,
        store,
        view,
        others,
        of: { meta, solutions, marked, compared: others.list, theme },
    });
    // What is seen first is the diagram.
    await new Promise((done) => requestAnimationFrame(() => window.setTimeout(done)));
    view.take(new MultiplierTable(await inflated(multiplierText()), meta.multipliers.solutions));

    function subtitle(): string {
        const counted = (count: number, one: string, several: string): string =>
            `${count} ${count === 1 ? one : several}`;
        const { factor, unit } = MEASURES.frequency;
        const [low, high] = meta.range.map((end) => Number((factor * end).toPrecision(12)));
        const branches = counted(meta.branches.length, "branch", "branches");
        const point = meta.point === "" ? "" : `; response of ${meta.point}`;
        const all = counted(solutions.count, "solution", "solutions");
        return `${branches}, ${all}, ${low} to ${high} ${unit}${point}`;
    }
}

start().catch((error: unknown) => {
    console.error(error);
    const page = document.getElementById("page") ?? document.body;
    page.append(
        element("p", { class: "notice", role: "alert" }, [
            `The page cannot be shown: ${error instanceof Error ? error.message : String(error)}. ` +
                "A browser of 2023 or later is needed.",
        ]),
    );
});
