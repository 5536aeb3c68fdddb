// Floquet multipliers of a solution in the complex plane, with the unit circle.

import { element, panel } from "./dom";
import { complex } from "./format";
import { Frame, MARGINS } from "./frame";
import type { Multiplier } from "./multiplier_table";
import type { Theme } from "./theme";

const HEIGHT = 300;
/** Largest distance from 0 that is drawn. */
const FARTHEST = 4;
/** Entries of the list. */
const LISTED = 12;

export class Multipliers {
    readonly root: HTMLElement;
    private readonly host = element("div", { class: "plot" });
    private readonly whose = element("p", { class: "note" });
    private readonly outside = element("p", { class: "note" });
    private readonly list = element("ol", { class: "multipliers" });
    private frame: Frame | null = null;
    private multipliers: Multiplier[] = [];

    constructor(private readonly theme: Theme) {
        this.root = panel("Floquet multipliers", "multipliers", [this.whose, this.host, this.outside, this.list]);
    }

    /** * `whose`: in words; `most`: how many there are, those that are not carried included. */
    show(multipliers: Multiplier[], whose: string, most: number): void {
        this.multipliers = multipliers;
        this.whose.textContent =
            multipliers.length === 0 ? `The page has no multipliers ${whose}.` : `${multipliers.length < most ? `The ${multipliers.length} largest of ${most}` : `All ${multipliers.length}`} ${whose}.`;
        const far = multipliers.filter((one) => !(modulus(one) <= this.reach()));
        this.outside.textContent = far.length === 0 ? "" : `Outside the frame: ${far.filter(([, im]) => im >= 0).map(([re, im]) => complex(re, im)).join(", ")}.`;
        // Of a pair the one above the axis stands for both.
        const listed = multipliers.filter(([, im]) => im >= 0).slice(0, LISTED).map(([re, im]) => element("li", {}, [`${complex(re, im)}`]));
        this.list.replaceChildren(...listed);
        if (this.frame === null) {
            const range = (): { x: [number, number]; y: [number, number]; logY: false } => {
                const across = this.reach() * ((this.host.clientWidth - MARGINS.across) / (HEIGHT - MARGINS.up));
                return { x: [-across, across], y: [-this.reach(), this.reach()], logY: false };
            };
            this.frame = new Frame(
                this.host,
                {
                    xLabel: () => "Real part",
                    yLabel: () => "Imaginary part",
                    range,
                    paint: (context, frame) => this.paint(context, frame),
                    height: () => HEIGHT,
                },
                this.theme,
            );
        } else {
            this.frame.redraw();
        }
    }

    /** Radii of the unit circle along both axes (canvas pixels). */
    unitCircle(): [number, number] {
        const frame = this.frame;
        return frame === null ? [0, 0] : [frame.toX(1) - frame.toX(0), frame.toY(0) - frame.toY(1)];
    }

    /** Distance from 0 that is drawn. */
    private reach(): number {
        const largest = this.multipliers.reduce((most, one) => Math.max(most, modulus(one)), 0);
        return largest <= FARTHEST / 1.15 ? Math.max(1.25, 1.15 * largest) : 1.6;
    }

    private paint(context: CanvasRenderingContext2D, frame: Frame): void {
        const density = frame.density;
        const { look } = this.theme;
        const centre = [frame.toX(0), frame.toY(0)] as const;
        context.lineWidth = 1.2 * density;
        context.strokeStyle = look.pale;
        context.beginPath();
        context.arc(...centre, frame.toX(1) - centre[0], 0, 2 * Math.PI);
        context.stroke();
        for (const one of this.multipliers) {
            if (modulus(one) <= this.reach()) {
                const isOutside = modulus(one) >= 1;
                context.beginPath();
                context.arc(frame.toX(one[0]), frame.toY(one[1]), 4 * density, 0, 2 * Math.PI);
                context.fillStyle = isOutside ? this.theme.period(2) : this.theme.period(1);
                context.fill();
                context.lineWidth = density;
                context.strokeStyle = look.paper;
                context.stroke();
            }
        }
    }
}

function modulus([re, im]: Multiplier): number {
    return Math.hypot(re, im);
}
