// What paints on a canvas, taken down as SVG: the part of a canvas context that the painters of the response
// diagram use.

import { short, type SvgOutline } from "./outline";

const escaped = (text: string): string =>
    text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll('"', "&quot;");
const ANCHORS: Partial<Record<CanvasTextAlign, string>> = { center: "middle", right: "end", end: "end" };

export class SvgContext {
    fillStyle = "#000000";
    strokeStyle = "#000000";
    lineWidth = 1;
    lineJoin = "miter";
    font = "12px sans-serif";
    textAlign: CanvasTextAlign = "left";
    textBaseline: CanvasTextBaseline = "alphabetic";
    private dash: number[] = [];
    private readonly parts: string[] = [];

    get markup(): string {
        return this.parts.join("\n");
    }

    /** Puts markup between what is drawn: the begin or the end of a group. */
    put(markup: string): void {
        this.parts.push(markup);
    }

    /** Nothing is shifted in what is made anew. */
    save(): void {}
    translate(): void {}
    restore(): void {}

    setLineDash(lengths: readonly number[]): void {
        this.dash = [...lengths];
    }

    stroke(outline: SvgOutline): void {
        if (outline.data !== "") {
            this.parts.push(`<path d="${outline.data}" fill="none"${this.pen()}/>`);
        }
    }

    fill(outline: SvgOutline): void {
        if (outline.data !== "") {
            this.parts.push(`<path d="${outline.data}" fill="${this.fillStyle}"/>`);
        }
    }

    fillRect(x: number, y: number, width: number, height: number): void {
        this.parts.push(
            `<rect x="${short(x)}" y="${short(y)}" width="${short(width)}" height="${short(height)}" ` +
                `fill="${this.fillStyle}"/>`,
        );
    }

    /** A line between two places. */
    line(from: readonly [number, number], to: readonly [number, number]): void {
        this.parts.push(
            `<path d="M${short(from[0])} ${short(from[1])}L${short(to[0])} ${short(to[1])}" ` +
                `fill="none"${this.pen()}/>`,
        );
    }

    fillText(text: string, x: number, y: number, turned = false): void {
        this.write(text, [x, y], `fill="${this.fillStyle}"`, turned);
    }

    strokeText(text: string, x: number, y: number): void {
        this.write(text, [x, y], `fill="none"${this.pen()}`, false);
    }

    private write(text: string, [x, y]: [number, number], look: string, turned: boolean): void {
        const [, size = "12", family = "sans-serif"] = /([\d.]+)px (.*)/.exec(this.font) ?? [];
        const down =
            this.textBaseline === "middle"
                ? 0.35 * Number(size)
                : this.textBaseline === "top"
                  ? 0.8 * Number(size)
                  : 0;
        const place = turned
            ? `transform="translate(${short(x)} ${short(y)}) rotate(-90)"`
            : `x="${short(x)}" y="${short(y + down)}"`;
        this.parts.push(
            `<text ${place} font-family="${escaped(family)}" font-size="${size}" ` +
                `text-anchor="${ANCHORS[this.textAlign] ?? "start"}" ${look}>${escaped(text)}</text>`,
        );
    }

    private pen(): string {
        const dash = this.dash.length === 0 ? "" : ` stroke-dasharray="${this.dash.map(short).join(" ")}"`;
        const width = `stroke-width="${short(this.lineWidth)}"`;
        return ` stroke="${this.strokeStyle}" ${width} stroke-linejoin="${this.lineJoin}"${dash}`;
    }
}
