// Printed figures of results that the page does not draw itself, under headings that open.

import { readFigures, type Figure, type Meta } from "./data";
import { element, panel } from "./dom";

export function figurePanel(meta: Meta): HTMLElement | null {
    const { carried, noRoom, refused } = meta.figures;
    if (carried.length + noRoom.length + refused.length === 0) {
        return null;
    }
    let documents: string[] | null = null;
    const shown = ({ name, description }: Figure, place: number): HTMLElement => {
        documents ??= readFigures();
        const source = URL.createObjectURL(new Blob([documents[place] ?? ""], { type: "image/svg+xml" }));
        const image = element("img", { src: source, alt: description });
        const caption = element("figcaption", {}, [element("b", {}, [name]), ` ${description}`]);
        return element("figure", {}, [image, caption]);
    };
    const places = carried.map((_, place) => place);
    const headings = [...new Set(carried.map(({ heading }) => heading))];
    const groups = headings.map((heading) => {
        const own = places.filter((place) => carried[place]?.heading === heading);
        const gallery = element("div", { class: "gallery" });
        const summary = element("summary", {}, [`${heading} (${own.length})`]);
        const made = element("details", {}, [summary, gallery]);
        made.addEventListener("toggle", () => {
            if (made.open && gallery.childElementCount === 0) {
                const nothing = { name: "", heading, description: "" };
                gallery.append(...own.map((place) => shown(carried[place] ?? nothing, place)));
            }
        });
        return made;
    });
    const left = [
        ...(noRoom.length > 0
            ? [
                  `There is no room on this page for ${noRoom.join(", ")}; ` +
                      "hammerbeam figure draws all of them as files.",
              ]
            : []),
        ...refused.map(([name, reason]) => `${name} cannot be drawn: ${reason}.`),
    ];
    const notes = left.map((sentence) => element("p", { class: "note" }, [sentence]));
    return panel(`Figures (${carried.length})`, "figures", [...groups, ...notes]);
}
