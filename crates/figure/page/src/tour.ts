// A short tour of the page: one place after the other, each with a sentence or two.

import { element } from "./dom";

const STOPS: readonly (readonly [selector: string, heading: string, text: string])[] = [
    [
        ".diagram",
        "The response diagram",
        "Each line is a branch of periodic solutions: solid where they are stable, dashed where they are " +
            "unstable. Marks are bifurcations; more of them appear as you zoom in. Zoom with the wheel, a " +
            "box or two fingers; click on a solution to see its motion.",
    ],
    [
        ".legend",
        "The legend",
        "Every entry is a switch: a kind of solutions, of lines or of marks, other results that you " +
            "compare with.",
    ],
    [
        ".controls",
        "What the axes show",
        "Any stored quantity over the frequency, over another quantity or over another parameter that was " +
            "varied. Save takes what is seen as SVG, PNG or CSV. Compare draws other results behind these.",
    ],
    [
        ".solution",
        "The selected solution",
        "Its numbers, the structure in motion, its Floquet multipliers, its orbit over time, in the phase " +
            "plane and as a spectrum. Arrow keys go along the branch.",
    ],
    [
        "#branches",
        "Branches",
        "All branches with their ranges. Press a head to sort, type to filter, untick to leave a branch out.",
    ],
    [
        "#bifurcations",
        "Bifurcations",
        "A row leads to its point. By its number a new run starts there, also with changed parameters.",
    ],
];

/** Starts the tour; Escape or the last step ends it, and the focus goes back to where it was. */
export function startTour(): void {
    const stops = STOPS.flatMap(([selector, heading, text]) => {
        const shown = document.querySelector<HTMLElement>(selector);
        return shown !== null && shown.getClientRects().length > 0 ? [{ shown, heading, text }] : [];
    });
    if (document.querySelector("dialog.tour") !== null) {
        return;
    }
    const before = document.activeElement;
    const heading = element("h2", {});
    const text = element("p", {});
    const back = element("button", { type: "button" }, ["Back"]);
    const next = element("button", { type: "button" });
    const stop = element("button", { type: "button" }, ["End"]);
    const card = element("dialog", { class: "tour", "aria-live": "polite" }, [
        heading,
        text,
        element("div", { class: "controls" }, [back, next, stop]),
    ]);
    let place = 0;
    const show = (): void => {
        const at = stops[place];
        stops.forEach(({ shown }, k) => shown.classList.toggle("toured", k === place));
        if (at !== undefined) {
            heading.textContent = `${at.heading} (${place + 1} of ${stops.length})`;
            text.textContent = at.text;
            at.shown.scrollIntoView({ block: "nearest", behavior: "instant" });
        }
        back.disabled = place === 0;
        next.textContent = place + 1 < stops.length ? "Next" : "Done";
        next.focus({ preventScroll: true });
    };
    const go = (by: number): void => {
        place += by;
        place < stops.length ? show() : card.close();
    };
    back.addEventListener("click", () => go(-1));
    next.addEventListener("click", () => go(1));
    stop.addEventListener("click", () => card.close());
    card.addEventListener("keydown", (event) => {
        if (event.key === "Escape") {
            card.close();
        }
    });
    card.addEventListener("close", () => {
        stops.forEach(({ shown }) => shown.classList.remove("toured"));
        card.remove();
        if (before instanceof HTMLElement) {
            before.focus({ preventScroll: true });
        }
    });
    document.body.append(card);
    // Not modal: what it speaks of can be seen, and tried.
    card.show();
    show();
}
