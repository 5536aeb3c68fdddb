// Outlines that are drawn: on a canvas, or as a path of an SVG document while one is made.

/** What outlines are made by: the part of Path2D that is used. */
export interface Outline {
    moveTo(x: number, y: number): void;
    lineTo(x: number, y: number): void;
    rect(x: number, y: number, width: number, height: number): void;
    /** A whole circle. */
    arc(x: number, y: number, radius: number, from: number, to: number): void;
    closePath(): void;
}

/** To a hundredth of a pixel. */
export const short = (value: number): string => String(Math.round(100 * value) / 100);

/** An outline as the data of an SVG path. */
export class SvgOutline implements Outline {
    private parts: string[] = [];

    get data(): string {
        return this.parts.join("");
    }

    moveTo(x: number, y: number): void {
        this.parts.push(`M${short(x)} ${short(y)}`);
    }

    lineTo(x: number, y: number): void {
        this.parts.push(`L${short(x)} ${short(y)}`);
    }

    rect(x: number, y: number, width: number, height: number): void {
        this.parts.push(`M${short(x)} ${short(y)}h${short(width)}v${short(height)}h${short(-width)}z`);
    }

    arc(x: number, y: number, radius: number): void {
        const [r, d] = [short(radius), short(2 * radius)];
        this.parts.push(`M${short(x - radius)} ${short(y)}a${r} ${r} 0 1 0 ${d} 0a${r} ${r} 0 1 0 -${d} 0z`);
    }

    closePath(): void {
        this.parts.push("z");
    }
}

let make: () => Outline = () => new Path2D();
let aside = 0.08;

/**
 * How far a line may pass beside points that it leaves out (pixels): an SVG is looked at closer than the
 * page.
 */
export function tolerance(): number {
    return aside;
}

/** An outline for what is drawn on now. */
export function newPath(): Outline {
    return make();
}

/** Draws with outlines of SVG. */
export function drawingSvg(draw: () => void): void {
    const before = [make, aside] as const;
    [make, aside] = [() => new SvgOutline(), 0.02];
    try {
        draw();
    } finally {
        [make, aside] = before;
    }
}
