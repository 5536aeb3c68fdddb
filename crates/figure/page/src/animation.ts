// The structure moving through one orbit period, played slowly.

import type { Structure } from "./data";
import { button, choice, element, panel } from "./dom";
import { drawBeam } from "./draw_beam";
import { drawMasses } from "./draw_masses";
import { drawMesh } from "./draw_mesh";
import { digits } from "./format";
import { layoutOf } from "./mass_layout";
import { largestDisplacement, poseAt } from "./motion";
import type { Orbit } from "./orbit";
import type { Theme } from "./theme";
import { MEASURES } from "./units";

const HEIGHT = 260;

export class Animation {
    readonly root: HTMLElement;
    private readonly canvas = element("canvas", { role: "img", "aria-label": "The structure in motion" });
    private readonly play = button("Pause", "Play or pause (space)", () => this.toggle());
    private readonly slider = element("input", {
        type: "range",
        min: "0",
        max: "1",
        step: "any",
        "aria-label": "Instant in the orbit period",
    });
    private readonly speed = element("p", { class: "note" });
    private orbit: Orbit | null = null;
    private frequency = 1;
    private largest = 0;
    private instant = 0;
    private seconds = 4;
    private playing = !window.matchMedia("(prefers-reduced-motion: reduce)").matches;
    private last = 0;

    constructor(
        private readonly structure: Structure | null,
        private readonly theme: Theme,
        private readonly at: (instant: number) => void,
    ) {
        const speeds = [
            ["2", "2 s"],
            ["4", "4 s"],
            ["8", "8 s"],
            ["20", "20 s"],
        ] as const;
        const pace = choice("One excitation period takes", speeds, (seconds) => {
            this.seconds = Number(seconds);
            this.tell();
        });
        pace.show("4");
        this.slider.addEventListener("input", () => {
            this.pause();
            this.instant = Number(this.slider.value) * (this.orbit?.period ?? 1);
            this.draw();
        });
        this.root = panel("The structure in motion", "motion", [
            this.canvas,
            element("div", { class: "controls" }, [this.play, this.slider, pace.root]),
            this.speed,
        ]);
        this.canvas.addEventListener(
            "mousemove",
            ({ offsetX }) => (this.canvas.title = this.nameAt(offsetX)),
        );
        theme.listen(() => this.draw());
        new ResizeObserver(() => this.draw()).observe(this.canvas);
        requestAnimationFrame((now) => this.step(now));
    }

    show(orbit: Orbit, frequency: number): void {
        [this.orbit, this.frequency] = [orbit, frequency];
        this.instant %= orbit.period;
        this.largest = this.structure === null ? 0 : largestDisplacement(this.structure, orbit);
        this.play.textContent = this.playing ? "Pause" : "Play";
        this.tell();
        this.draw();
    }

    toggle(): void {
        this.playing = !this.playing;
        this.play.textContent = this.playing ? "Pause" : "Play";
    }

    private pause(): void {
        if (this.playing) {
            this.toggle();
        }
    }

    private step(now: number): void {
        const passed = Math.min(0.1, (now - this.last) / 1000);
        this.last = now;
        if (this.playing && this.orbit !== null && !document.hidden && this.root.offsetParent !== null) {
            this.instant = (this.instant + passed / this.seconds) % this.orbit.period;
            this.draw();
        }
        requestAnimationFrame((next) => this.step(next));
    }

    private draw(): void {
        const width = this.canvas.clientWidth;
        const context = this.canvas.getContext("2d");
        if (this.orbit === null || this.structure === null || context === null || width === 0) {
            return;
        }
        const density = window.devicePixelRatio;
        const [across, up] = [Math.round(width * density), Math.round(HEIGHT * density)];
        if (this.canvas.width !== across || this.canvas.height !== up) {
            [this.canvas.width, this.canvas.height] = [across, up];
        }
        context.setTransform(density, 0, 0, density, 0, 0);
        context.clearRect(0, 0, width, HEIGHT);
        const sketch = { context, width, height: HEIGHT, theme: this.theme };
        this.slider.value = String(this.instant / this.orbit.period);
        const pose = poseAt(this.structure, this.orbit, this.instant);
        const largest = this.largest || 1;
        if (this.structure.mesh !== null) {
            this.enlarged = drawMesh(sketch, this.structure, this.structure.mesh, pose, largest);
        } else if (this.structure.beam) {
            this.enlarged = drawBeam(sketch, this.structure, pose, (0.36 * HEIGHT) / largest);
        } else {
            this.isNamed = drawMasses(
                sketch,
                this.structure,
                pose,
                layoutOf(this.structure.places.length, width).room / largest,
            );
        }
        this.tell();
        this.at(this.instant);
    }

    private enlarged = 0;
    /** Whether every mass has its name beside it. */
    private isNamed = true;

    /** The name of the mass at a distance from the left (CSS pixels), which may be cut in the drawing. */
    private nameAt(left: number): string {
        const isMasses = this.structure?.beam === false && this.structure.mesh === null;
        const places = isMasses ? (this.structure?.places ?? []) : [];
        const { rest, spacing } = layoutOf(places.length, this.canvas.clientWidth);
        return places.find((_, k) => Math.abs((rest[k] ?? NaN) - left) <= spacing / 2)?.name ?? "";
    }

    private tell(): void {
        const slower = this.seconds * this.frequency;
        const pace =
            slower >= 1 ? `${digits(slower, 3)} times slower` : `${digits(1 / slower, 3)} times faster`;
        const size =
            this.enlarged > 0
                ? ` Displacements are drawn ${digits(this.enlarged, 2)} times larger than lengths.`
                : "";
        const { factor, unit } = MEASURES.displacement;
        const largest = `${digits(factor * this.largest, 3)} ${unit}`;
        const text =
            `Played ${pace}.${size} Largest displacement: ${largest}. A stop is coloured while it is ` +
            `pressed, a rigid one for a moment at an impact.` +
            (this.isNamed ? "" : " Point at a mass for its name.");
        if (this.speed.textContent !== text) {
            this.speed.textContent = text;
        }
    }
}
