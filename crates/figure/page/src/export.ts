// The visible diagram as SVG, PNG and CSV.

import { isOverFrequency } from "./chaos";
import type { Ending } from "./controls";
import type { Branch, Meta, Solutions } from "./data";
import type { Frame } from "./frame";
import { entriesOf, SAMPLE, type LegendOf } from "./legend";
import { eventWords } from "./marks";
import { drawingSvg } from "./outline";
import { paintResponse, SANS, type Scene } from "./response_paint";
import { SvgContext } from "./svg_context";

/** Pixels of a PNG for each pixel of the page. */
const FINE = 3;
/** Height of a row of the legend, and room around the figure (CSS pixels). */
const ROW = 20;
const MARGIN = 8;

/** The diagram with its axes, its legend below, as an SVG document. */
function diagramSvg(frame: Frame, shown: Scene, of: LegendOf): string {
    // The ring around the selected solution is for the reader of the page.
    const { kept: _, ...fresh } = shown;
    const scene: Scene = { ...fresh, state: { ...shown.state, selected: -1 } };
    const svg = new SvgContext();
    const { density, plot } = frame;
    const width = plot.width;
    const rows = legendRows(of, scene, width - 2 * MARGIN);
    const height = plot.height + 2 * MARGIN + ROW * rows.length;
    const { paper } = scene.theme.look;
    // Else browsers round the advance of each glyph to pixels, and letters stand apart.
    svg.put(
        `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" ` +
            `viewBox="0 0 ${width} ${height}" text-rendering="geometricPrecision">`,
    );
    const title = of.meta.title || "Response diagram";
    svg.put(`<title>${title.replaceAll("&", "&amp;").replaceAll("<", "&lt;")}</title>`);
    svg.fillStyle = paper;
    svg.fillRect(0, 0, width, height);
    svg.put(`<g transform="translate(0 ${MARGIN}) scale(${1 / density})">`);
    drawingSvg(() => {
        drawGrid(svg, frame, scene);
        const { left, top, width: across, height: up } = plot.bbox;
        svg.put(
            `<clipPath id="frame"><rect x="${left}" y="${top}" width="${across}" height="${up}"/>` +
                '</clipPath><g clip-path="url(#frame)">',
        );
        paintResponse(svg as unknown as CanvasRenderingContext2D, frame, scene);
        svg.put("</g>");
        drawAxes(svg, frame, scene);
        svg.put("</g>");
        rows.forEach((row, k) =>
            row.forEach(([x, entry]) => {
                svg.put(`<g transform="translate(${x} ${plot.height + MARGIN + ROW * k})">`);
                entry.draw(svg as unknown as CanvasRenderingContext2D);
                svg.font = `12px ${SANS}`;
                [svg.textAlign, svg.textBaseline] = ["left", "middle"];
                svg.fillStyle = scene.theme.look.ink;
                svg.fillText(entry.name, SAMPLE + 6, 8);
                svg.put("</g>");
            }),
        );
    });
    svg.put("</svg>");
    return svg.markup;
}

/** Entries of the legend that are on, in rows, each with its place. */
function legendRows(
    of: LegendOf,
    { state }: Scene,
    width: number,
): [number, ReturnType<typeof entriesOf>[number]][][] {
    const rows: [number, ReturnType<typeof entriesOf>[number]][][] = [];
    let next = Infinity;
    for (const entry of entriesOf(of, state).filter(({ isOn }) => isOn)) {
        const wide = SAMPLE + 6 + 6.6 * entry.name.length + 18;
        if (next + wide > width + MARGIN) {
            rows.push([]);
            next = MARGIN;
        }
        rows.at(-1)?.push([next, entry]);
        next += wide;
    }
    return rows;
}

function drawGrid(svg: SvgContext, frame: Frame, { theme }: Scene): void {
    const { left, top, width, height } = frame.plot.bbox;
    svg.strokeStyle = theme.look.grid;
    svg.lineWidth = frame.density;
    svg.setLineDash([]);
    for (const [value] of frame.ticks.x.labelled) {
        svg.line([frame.toX(value), top], [frame.toX(value), top + height]);
    }
    for (const [value] of frame.ticks.y.labelled) {
        svg.line([left, frame.toY(value)], [left + width, frame.toY(value)]);
    }
}

function drawAxes(svg: SvgContext, frame: Frame, { theme }: Scene): void {
    const { density } = frame;
    const { left, top, width, height } = frame.plot.bbox;
    svg.put(
        `<rect x="${left}" y="${top}" width="${width}" height="${height}" fill="none" ` +
            `stroke="${theme.look.pale}" stroke-width="${density}"/>`,
    );
    svg.fillStyle = theme.look.ink;
    svg.font = `${12 * density}px ${SANS}`;
    [svg.textAlign, svg.textBaseline] = ["center", "top"];
    for (const [value, label] of frame.ticks.x.labelled) {
        svg.fillText(label, frame.toX(value), top + height + 6 * density);
    }
    [svg.textAlign, svg.textBaseline] = ["right", "middle"];
    for (const [value, label] of frame.ticks.y.labelled) {
        svg.fillText(label, left - 7 * density, frame.toY(value));
    }
    svg.font = `${13 * density}px ${SANS}`;
    [svg.textAlign, svg.textBaseline] = ["center", "top"];
    svg.fillText(frame.label.x, left + 0.5 * width, top + height + 28 * density);
    svg.textBaseline = "alphabetic";
    svg.fillText(frame.label.y, 14 * density, top + 0.5 * height, true);
}

/** The same as pixels, three to a pixel of the page. */
async function diagramPng(svg: string): Promise<Blob> {
    const image = new Image();
    image.src = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
    try {
        await image.decode();
        const canvas = document.createElement("canvas");
        [canvas.width, canvas.height] = [FINE * image.width, FINE * image.height];
        canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
        const blob = await new Promise<Blob | null>((done) => canvas.toBlob(done, "image/png"));
        if (blob === null) {
            throw new Error("this browser makes no PNG of it");
        }
        return blob;
    } finally {
        URL.revokeObjectURL(image.src);
    }
}

const number = (value: number | undefined): string =>
    value === undefined || Number.isNaN(value) ? "" : String(value);

/**
 * The solutions that are seen, with the columns of branches.csv in SI; of branches over another parameter
 * that, too.
 */
function diagramCsv(frame: Frame, { meta, solutions, curves, state }: Scene): string {
    const {
        x: [left, right],
        y: [low, high],
    } = frame.range();
    const [across, upright] = [curves.across(state), curves.values(state.quantity, state.over)];
    const parameter = meta.parameters[state.over - 1];
    const named =
        parameter === undefined
            ? []
            : [
                  `${parameter.title} ${parameter.si}`
                      .trim()
                      .toLowerCase()
                      .replaceAll(/[^a-z0-9]+/g, "_"),
              ];
    const titles = [
        "branch",
        "period_multiple",
        "frequency_hz",
        "max_abs_displacement_m",
        "max_abs_acceleration_m_s2",
        "max_contact_force_n",
        "max_impact_velocity_m_s",
        "contacts",
        "leading_multiplier_re",
        "leading_multiplier_im",
        "stable",
        "event",
        "energy_j",
        ...named,
    ];
    const lines = [titles.join(",")];
    meta.branches.forEach((branch, place) => {
        for (let k = branch.first; k < branch.first + branch.count && !state.hidden.has(place); k++) {
            const [x, y] = [across[k] ?? NaN, upright[k] ?? NaN];
            if (x >= left && x <= right && y >= low && y <= high) {
                lines.push(
                    [...row(branch, solutions, k), ...named.map(() => number(solutions.parameter[k]))].join(
                        ",",
                    ),
                );
            }
        }
    });
    return `${lines.join("\n")}\n`;
}

function row(branch: Branch, solutions: Solutions, k: number): string[] {
    const { maxima, frequency, contacts, multiplierRe, multiplierIm, energy, flags } = solutions;
    const { stability, events } = eventWords(flags[k] ?? 0);
    const values = [
        maxima.displacement,
        maxima.acceleration,
        maxima.force,
        maxima.velocity,
        contacts,
        multiplierRe,
        multiplierIm,
    ].map((column) => number(column[k]));
    return [
        String(branch.id),
        String(branch.period),
        number(frequency[k]),
        ...values,
        stability,
        events,
        number(energy[k]),
    ];
}

/** A name for a file of the diagram. */
function fileName(meta: Meta, scene: Scene, ending: string): string {
    const { state } = scene;
    const over = isOverFrequency(state)
        ? ""
        : `-over-${state.across === "parameter" ? `parameter-${state.over}` : state.across}`;
    return `${meta.folder || "diagram"}-${state.quantity}${over}.${ending}`;
}

/** What is seen, as the contents of a file. */
export async function saved(frame: Frame, scene: Scene, ending: Ending, of: LegendOf): Promise<Blob> {
    if (ending === "csv") {
        return new Blob([diagramCsv(frame, scene)], { type: "text/csv" });
    }
    const svg = diagramSvg(frame, scene, of);
    return ending === "svg" ? new Blob([svg], { type: "image/svg+xml" }) : diagramPng(svg);
}

/** Hands what is seen to the reader as a file. */
export async function save(frame: Frame, scene: Scene, ending: Ending, of: LegendOf): Promise<void> {
    download(await saved(frame, scene, ending, of), fileName(of.meta, scene, ending));
}

/** Hands a file to the reader. */
function download(content: Blob, name: string): void {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(content);
    link.download = name;
    link.click();
    window.setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
