// The line of switches above the diagram.

import type { Meta, Quantity } from "./data";
import { button, choice, element, toggle } from "./dom";
import { MEASURES } from "./format";
import type { Store } from "./state";

export interface Commands {
    quantity: (quantity: Quantity) => void;
    whole: () => void;
    zoom: (factor: number) => void;
    copyLink: () => void;
    help: () => void;
}

/** * `quantities`: those of which there is something. */
export function controls(meta: Meta, quantities: readonly Quantity[], store: Store, commands: Commands): HTMLElement {
    const options = quantities.map((quantity) => [quantity, MEASURES[quantity].name] as const);
    const quantity = choice("Show", options, commands.quantity);
    const scale = choice("Scale", [["log", "logarithmic"], ["linear", "linear"]] as const, (value) => store.update({ log: value === "log", view: null }));
    const theme = choice("Colours", [["auto", "as the system"], ["light", "light"], ["dark", "dark"]] as const, (value) => store.update({ theme: value }));
    const marks = toggle("marks", (on) => store.update({ marks: on }));
    const measured = choice("Measured", [["shifted", "as compared"], ["plain", "as measured"]] as const, (value) => store.update({ shifted: value === "shifted" }));
    const show = (): void => {
        const { state } = store;
        quantity.show(state.quantity);
        scale.show(state.log ? "log" : "linear");
        theme.show(state.theme);
        marks.show(state.marks);
        measured.show(state.shifted ? "shifted" : "plain");
    };
    store.listen(show);
    show();
    const over = meta.measured.length > 0 ? [measured.root] : [];
    return element("div", { class: "controls" }, [
        quantity.root,
        scale.root,
        marks.root,
        ...over,
        button("+", "Zoom in (+)", () => commands.zoom(0.6)),
        button("−", "Zoom out (−)", () => commands.zoom(1 / 0.6)),
        button("Everything", "Show everything (0)", commands.whole),
        element("span", { class: "of-page" }, [
            theme.root,
            button("Copy link", "Copy a link to what is shown (c)", commands.copyLink),
            button("Print", "Print this page", () => window.print()),
            button("Keys", "List of keys (?)", commands.help),
        ]),
    ]);
}
