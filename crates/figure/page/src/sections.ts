// Motions that do not repeat: their stroboscopic points, and the ranges in which they are chaotic.

import { nearestSection } from "./chaos";
import { readSection, type Meta, type Section } from "./data";
import { button, choice, element, panel } from "./dom";
import { digits, hertz, shortHertz } from "./format";
import { Frame } from "./frame";
import { ends } from "./line_plot";
import type { Store } from "./state";
import type { Theme } from "./theme";
import { rangeText } from "./tip";
import { MEASURES } from "./units";

/** What a section is, in words. */
function sectionText(section: Section, carried: number): string {
    const [exponent, half] = section.exponent ?? [null, null];
    const judged = section.kind === null ? "" : `, ${section.kind}`;
    const parts = [`${hertz(section.frequency)}${judged} (${section.origin}).`];
    parts.push(
        carried < section.count
            ? `${carried} of ${section.count} points at phase 0 of the excitation.`
            : `${carried} points at phase 0 of the excitation.`,
    );
    if (section.next) {
        parts.push("A sweep keeps displacements alone: each is drawn over that of the period before.");
    }
    if (exponent !== null) {
        parts.push(
            `Largest Lyapunov exponent ${digits(exponent, 4)} ± ${digits(half ?? NaN, 2)} 1/s ` +
                "(95 per cent).",
        );
    }
    if (section.dimension !== null) {
        parts.push(`Kaplan-Yorke dimension ${digits(section.dimension, 3)}.`);
    }
    return parts.join(" ");
}

/** * `open`: opens a section, `show`: shows a range of the diagram. */
export function sectionPanel(
    meta: Meta,
    store: Store,
    theme: Theme,
    open: (place: number) => void,
    show: (range: [number, number]) => void,
): HTMLElement | null {
    if (meta.sections.length + meta.chaos.length === 0) {
        return null;
    }
    const ranges = meta.chaos.map((range) =>
        button(rangeText(range), "Show this range and the chaotic motion nearest to its middle", () => {
            show(range);
            open(nearestSection(meta, 0.5 * (range[0] + range[1]), range));
        }),
    );
    const head =
        ranges.length === 0
            ? []
            : [element("div", { class: "controls ranges" }, ["Chaotic ranges", ...ranges])];
    if (meta.sections.length === 0) {
        return panel("Chaotic motion", "section", [
            ...head,
            element("p", { class: "note" }, ["No section of a motion is stored."]),
        ]);
    }
    const host = element("div", { class: "plot" });
    const words = element("p", { class: "note" });
    const options = meta.sections.map(
        (section, k) =>
            [
                String(k),
                `${shortHertz(section.frequency, 7)}${section.kind === null ? "" : `, ${section.kind}`} ` +
                    `(${section.origin})`,
            ] as const,
    );
    const chosen = choice("Motion", options, (value) => store.update({ section: Number(value) }));
    const root = panel("Poincaré section", "section", [
        ...head,
        element("div", { class: "controls" }, [chosen.root]),
        host,
        words,
    ]);
    const section = (): Section | undefined => meta.sections[store.state.section];
    let points: [number, number][] = [];
    const read = (): void => {
        const shown = section();
        points =
            shown === undefined
                ? []
                : readSection(shown).map(([x, y]) => [
                      MEASURES.displacement.factor * x,
                      shown.next ? MEASURES.displacement.factor * y : y,
                  ]);
        words.textContent = shown === undefined ? "" : sectionText(shown, points.length);
        chosen.show(String(store.state.section));
        root.dataset["points"] = String(points.length);
    };
    let frame: Frame | null = null;
    // The frame needs its place on the page to know its width.
    queueMicrotask(() => {
        frame = new Frame(
            host,
            {
                xLabel: () => `Displacement (${MEASURES.displacement.unit})`,
                yLabel: () =>
                    section()?.next === true
                        ? `One period later (${MEASURES.displacement.unit})`
                        : "Velocity (m/s)",
                range: () => ({
                    x: ends([points.map(([x]) => x)]),
                    y: ends([points.map(([, y]) => y)]),
                    logY: false,
                }),
                height: () => 300,
                paint: (context, at) => {
                    context.fillStyle = theme.period(1);
                    const half = (points.length > 1000 ? 1 : 1.7) * at.density;
                    for (const [x, y] of points) {
                        context.fillRect(at.toX(x) - half, at.toY(y) - half, 2 * half, 2 * half);
                    }
                },
            },
            theme,
        );
    });
    store.listen((_, changed) => {
        if (changed.has("section")) {
            read();
            frame?.redraw();
        }
    });
    read();
    return root;
}
