// What lines, colours and marks of the response diagram mean.

import type { Meta, Solutions } from "./data";
import { element } from "./dom";
import { markedSolutions } from "./marks";
import type { Theme } from "./theme";

const SIZE = 16;

/** A line of samples with their names; drawn anew when the colours change. */
export function legend(meta: Meta, solutions: Solutions, theme: Theme): HTMLElement {
    const marks = [...markedSolutions(solutions)].filter(([, found]) => found.length > 0).map(([mark]) => mark);
    const root = element("div", { class: "legend", "aria-label": "Legend" });
    const fill = (): void => {
        const periods = [...new Set(meta.branches.map((branch) => branch.period))].sort((a, b) => a - b);
        const items = periods.map((period) => lineItem(`period ${period}`, theme.period(period), []));
        items.push(lineItem("stable", theme.look.ink, []), lineItem("unstable", theme.look.ink, [4, 3]));
        items.push(...marks.map((mark) => item(mark.name, (context) => {
            const path = new Path2D();
            mark.outline(path, SIZE / 2 + 4, SIZE / 2, mark.radius);
            context.fillStyle = mark.isFilled ? theme.look.ink : theme.look.paper;
            context.fill(path);
            context.strokeStyle = mark.isPale ? theme.look.pale : theme.look.ink;
            context.stroke(path);
        })));
        if (meta.chaos.length > 0) {
            items.push(item("chaotic motion", (context) => {
                context.fillStyle = theme.look.shade;
                context.fillRect(0, 0, 24, SIZE);
                context.strokeStyle = theme.look.pale;
                context.strokeRect(0.5, 0.5, 23, SIZE - 1);
            }));
        }
        if (meta.sections.length > 0) {
            items.push(item("the Poincaré section shown", (context) => {
                context.strokeStyle = theme.look.pale;
                context.lineWidth = 1.5;
                context.setLineDash([2, 3]);
                context.beginPath();
                context.moveTo(12, 0);
                context.lineTo(12, SIZE);
                context.stroke();
            }));
        }
        if (meta.motions.length > 0) {
            items.push(item("motion that does not repeat", (context) => {
                context.fillStyle = theme.look.pale;
                context.beginPath();
                context.arc(12, SIZE / 2, 2.5, 0, 2 * Math.PI);
                context.fill();
            }));
        }
        if (meta.measured.length > 0) {
            items.push(item(`measured: ${meta.measured.map((series) => series.name).join(", ")}`, (context) => {
                context.strokeStyle = theme.look.ink;
                context.beginPath();
                context.moveTo(8, 4);
                context.lineTo(16, 12);
                context.moveTo(8, 12);
                context.lineTo(16, 4);
                context.stroke();
            }));
        }
        root.replaceChildren(...items);
    };
    fill();
    theme.listen(fill);
    return root;
}

function lineItem(name: string, colour: string, dash: number[]): HTMLElement {
    return item(name, (context) => {
        context.strokeStyle = colour;
        context.lineWidth = dash.length > 0 ? 1.1 : 2;
        context.setLineDash(dash);
        context.beginPath();
        context.moveTo(0, SIZE / 2);
        context.lineTo(24, SIZE / 2);
        context.stroke();
    });
}

function item(name: string, draw: (context: CanvasRenderingContext2D) => void): HTMLElement {
    const canvas = element("canvas", { "aria-hidden": "true" });
    const density = window.devicePixelRatio;
    [canvas.width, canvas.height] = [24 * density, SIZE * density];
    canvas.style.cssText = `width:24px;height:${SIZE}px`;
    const context = canvas.getContext("2d");
    if (context !== null) {
        context.scale(density, density);
        draw(context);
    }
    return element("span", { class: "item" }, [canvas, name]);
}
