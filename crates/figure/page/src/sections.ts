// Motions that do not repeat: their stroboscopic points.

import type { Meta } from "./data";
import { choice, element, panel } from "./dom";
import { digits, hertz } from "./format";
import { Frame } from "./frame";
import { ends } from "./line_plot";
import type { Store } from "./state";
import type { Theme } from "./theme";

export function sectionPanel(meta: Meta, store: Store, theme: Theme): HTMLElement | null {
    if (meta.sections.length === 0) {
        return null;
    }
    const host = element("div", { class: "plot" });
    const words = element("p", { class: "note" });
    const options = meta.sections.map((section, k) => [String(k), hertz(section.frequency)] as const);
    const chosen = choice("Excitation frequency", options, (value) => store.update({ section: Number(value) }));
    const root = panel("Poincaré section", "section", [element("div", { class: "controls" }, [chosen.root]), host, words]);
    const points = (): [number, number][] => {
        const all = meta.sections[store.state.section]?.points ?? [];
        return all.filter((point): point is [number, number] => point[0] !== null && point[1] !== null).map(([y, v]) => [1e3 * y, v]);
    };
    const tell = (): void => {
        const section = meta.sections[store.state.section];
        const [exponent, half] = section?.exponent ?? [null, null];
        const parts = [`${points().length} points at phase 0 of the excitation.`];
        if (exponent !== null) {
            parts.push(`Largest Lyapunov exponent ${digits(exponent, 4)} ± ${digits(half ?? NaN, 2)} 1/s (95 per cent).`);
        }
        if (section?.dimension !== null && section?.dimension !== undefined) {
            parts.push(`Kaplan-Yorke dimension ${digits(section.dimension, 3)}.`);
        }
        words.textContent = parts.join(" ");
        chosen.show(String(store.state.section));
    };
    let frame: Frame | null = null;
    // The frame needs its place on the page to know its width.
    queueMicrotask(() => {
        frame = new Frame(host, {
            xLabel: () => "Displacement (mm)",
            yLabel: () => "Velocity (m/s)",
            range: () => ({ x: ends([points().map(([x]) => x)]), y: ends([points().map(([, y]) => y)]), logY: false }),
            height: () => 300,
            paint: (context, at) => {
                context.fillStyle = theme.period(1);
                const found = points();
                const half = (found.length > 1000 ? 1 : 1.7) * at.density;
                for (const [x, y] of found) {
                    context.fillRect(at.toX(x) - half, at.toY(y) - half, 2 * half, 2 * half);
                }
            },
        }, theme);
    });
    store.listen((_, changed) => {
        if (changed.has("section")) {
            tell();
            frame?.redraw();
        }
    });
    tell();
    return root;
}
