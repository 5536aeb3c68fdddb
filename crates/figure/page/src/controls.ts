// The line of switches above the diagram.

import type { Meta } from "./data";
import { button, choice, element, toggle } from "./dom";
import type { State, Store } from "./state";
import { measureOf, type Axis } from "./units";

export interface Commands {
    quantity: (quantity: Axis) => void;
    across: (across: Axis) => void;
    over: (over: number) => void;
    whole: () => void;
    zoom: (factor: number) => void;
    save: (ending: Ending) => void;
    compare: (files: readonly File[]) => void;
    copyLink: () => void;
    tour: () => void;
    help: () => void;
}

/** Formats of the visible diagram. */
export type Ending = "svg" | "png" | "csv";

const ENDINGS: readonly (readonly [Ending | "", string])[] = [
    ["", "Save…"],
    ["svg", "SVG, for print"],
    ["png", "PNG, pixels"],
    ["csv", "CSV, its solutions"],
];

/** * `quantities`: those of which there is something. */
export function controls(
    meta: Meta,
    quantities: readonly Axis[],
    store: Store,
    commands: Commands,
): HTMLElement {
    const named = (axis: Axis): readonly [Axis, string] => [
        axis,
        measureOf(meta, axis, store.state.over).name,
    ];
    const quantity = choice("Show", quantities.map(named), commands.quantity);
    const over = meta.parameters.map(
        (parameter, k) => [String(k + 1), parameter.title.toLowerCase()] as const,
    );
    const set = choice("Branches over", [["0", "frequency"] as const, ...over], (value) =>
        commands.over(Number(value)),
    );
    const across = choice(
        "Over",
        [
            ["parameter", meta.parameters.length > 0 ? "their parameter" : "frequency"] as const,
            ...quantities.map(named),
        ],
        commands.across,
    );
    const scale = choice(
        "Scale",
        [
            ["log", "logarithmic"],
            ["linear", "linear"],
        ] as const,
        (value) => store.update({ log: value === "log", view: null }),
    );
    const theme = choice(
        "Colours",
        [
            ["auto", "as the system"],
            ["light", "light"],
            ["dark", "dark"],
        ] as const,
        (value) => store.update({ theme: value }),
    );
    const marks = toggle("marks", (on) => store.update({ marks: on }));
    const numbers = toggle("numbers", (on) => store.update({ numbers: on }));
    const measured = choice(
        "Measured",
        [
            ["shifted", "as compared"],
            ["plain", "as measured"],
        ] as const,
        (value) => store.update({ shifted: value === "shifted" }),
    );
    const save = choice("", ENDINGS, (ending) => {
        save.show("");
        if (ending !== "") {
            commands.save(ending);
        }
    });
    save.root.title = "Save what is seen of the diagram";
    save.root.querySelector("select")?.setAttribute("aria-label", "Save what is seen of the diagram");
    const show = ({
        quantity: shown,
        across: right,
        over: of,
        log,
        theme: colours,
        marks: areMarked,
        numbers: areNumbered,
        shifted,
    }: State): void => {
        quantity.show(shown);
        across.show(right);
        set.show(String(of));
        scale.show(log ? "log" : "linear");
        theme.show(colours);
        marks.show(areMarked);
        numbers.show(areNumbered);
        measured.show(shifted ? "shifted" : "plain");
    };
    store.listen(show);
    show(store.state);
    return element("div", { class: "controls" }, [
        quantity.root,
        ...(meta.parameters.length > 0 ? [set.root] : []),
        across.root,
        scale.root,
        marks.root,
        numbers.root,
        ...(meta.measured.length > 0 ? [measured.root] : []),
        button("+", "Zoom in (+)", () => commands.zoom(0.6)),
        button("−", "Zoom out (−)", () => commands.zoom(1 / 0.6)),
        button("Everything", "Show everything (0)", commands.whole),
        element("span", { class: "of-page" }, [
            save.root,
            opener(commands.compare),
            theme.root,
            button("Copy link", "Copy a link to what is shown (c)", commands.copyLink),
            button("Print", "Print this page", () => window.print()),
            button("Tour", "What is where, in a minute (t)", commands.tour),
            button("Keys", "List of keys (?)", commands.help),
        ]),
    ]);
}

/** A button that opens files to compare with. */
function opener(opened: (files: readonly File[]) => void): HTMLElement {
    const input = element("input", { type: "file", accept: ".html,.csv", multiple: "", hidden: "" });
    input.addEventListener("change", () => {
        opened([...(input.files ?? [])]);
        input.value = "";
    });
    const press = button(
        "Compare…",
        "Draw the branches of other pages or tables of branches behind these; " +
            "or drop their files onto the diagram",
        () => input.click(),
    );
    return element("span", {}, [press, input]);
}
