// Floquet multipliers of a solution in the complex plane, with the unit circle.

import { element, panel } from "./dom";
import { complex } from "./format";
import { Frame, MARGINS } from "./frame";
import type { Multiplier } from "./multiplier_table";
import { edgesOf, isWithin, type Edges } from "./plane";
import type { Theme } from "./theme";

/** Height at most (CSS pixels); less where the frame is narrow: it is no higher than wide. */
const HEIGHT = 300;
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
        this.root = panel("Floquet multipliers", "multipliers", [
            this.whose,
            this.host,
            this.outside,
            this.list,
        ]);
    }

    /**
     * * `whose`: in words; `most`: how many there are, those that are not carried included; below 0 where
     *   that is not known yet.
     */
    show(multipliers: Multiplier[], whose: string, most: number): void {
        this.multipliers = multipliers;
        this.whose.textContent =
            most < 0
                ? ""
                : multipliers.length === 0
                  ? `The page has no multipliers ${whose}.`
                  : multipliers.length < most
                    ? `The ${multipliers.length} largest of ${most} ${whose}.`
                    : `All ${multipliers.length} ${whose}.`;
        // Of a pair the one above the axis stands for both.
        const listed = multipliers
            .filter(([, im]) => im >= 0)
            .slice(0, LISTED)
            .map(([re, im]) => element("li", {}, [`${complex(re, im)}`]));
        this.list.replaceChildren(...listed);
        if (this.frame === null) {
            const range = (): { x: [number, number]; y: [number, number]; logY: false } => {
                const [across, up] = this.edges();
                return { x: [-across, across], y: [-up, up], logY: false };
            };
            this.frame = new Frame(
                this.host,
                {
                    xLabel: () => "Real part",
                    yLabel: () => "Imaginary part",
                    range,
                    paint: (context, frame) => this.paint(context, frame),
                    height: () => this.height(),
                    space: 44,
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

    private height(): number {
        return Math.max(160, Math.min(HEIGHT, this.host.clientWidth - MARGINS.across + MARGINS.up));
    }

    private edges(): Edges {
        return edgesOf(this.multipliers, this.host.clientWidth - MARGINS.across, this.height() - MARGINS.up);
    }

    /** Says what lies outside the frame, of a pair one for both. */
    private tell(edges: Edges): void {
        const far = this.multipliers.filter((one) => one[1] >= 0 && !isWithin(one, edges));
        this.outside.textContent =
            far.length === 0
                ? ""
                : `Outside the frame: ${far.map(([re, im]) => complex(re, im)).join(", ")}.`;
    }

    private paint(context: CanvasRenderingContext2D, frame: Frame): void {
        const density = frame.density;
        const { look } = this.theme;
        const edges: Edges = [frame.range().x[1], frame.range().y[1]];
        this.tell(edges);
        const centre = [frame.toX(0), frame.toY(0)] as const;
        context.lineWidth = 1.2 * density;
        context.strokeStyle = look.pale;
        context.beginPath();
        context.arc(...centre, frame.toX(1) - centre[0], 0, 2 * Math.PI);
        context.stroke();
        for (const one of this.multipliers) {
            if (isWithin(one, edges)) {
                const isOutside = Math.hypot(...one) >= 1;
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
