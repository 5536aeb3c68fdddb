// The selected solution: its numbers and multipliers, its orbit or the nearest one carried, the structure in
// motion.

import { Animation } from "./animation";
import { orbitText, type Meta, type Solutions } from "./data";
import { button, element, panel } from "./dom";
import { hertz } from "./format";
import type { Multiplier, MultiplierTable } from "./multiplier_table";
import { Multipliers } from "./multipliers";
import { numbersOf } from "./numbers";
import { nearestOrbit, readOrbit, recordPlaces, type Orbit } from "./orbit";
import { OrbitPlots } from "./orbit_plots";
import type { Store } from "./state";
import type { Theme } from "./theme";

export class SolutionView {
    readonly root = element("div", { class: "solution" });
    readonly animation: Animation;
    private readonly numbers = element("dl", { class: "numbers" });
    private readonly which = element("p", { class: "which", role: "status" });
    private readonly plots: OrbitPlots;
    private readonly multipliers: Multipliers;
    private readonly orbitParts: HTMLElement[];
    private readonly start = element("p", { class: "note start" });
    private text: string | null = null;
    private readonly places: Uint32Array;
    private table: MultiplierTable | null = null;
    /** The orbit that is shown. */
    orbit: Orbit | null = null;

    constructor(
        private readonly meta: Meta,
        private readonly solutions: Solutions,
        private readonly store: Store,
        theme: Theme,
        private readonly numbersOfEvents: ReadonlyMap<number, number>,
        private readonly copy: (text: string) => void,
    ) {
        this.places = recordPlaces(meta.orbits.lengths);
        this.plots = new OrbitPlots(meta, solutions, theme);
        this.multipliers = new Multipliers(theme);
        this.animation = new Animation(meta.structure, theme, (instant) => this.plots.point(instant));
        this.orbitParts = [this.animation.root, this.plots.root];
        const heading = panel("Selected solution", "selected", [this.numbers, this.start, this.which]);
        const top = element("div", { class: "top" }, [heading, this.animation.root, this.multipliers.root]);
        this.root.append(top, this.plots.root);
        store.listen((_, changed) => {
            if (changed.has("selected")) {
                this.show();
            }
        });
    }

    show(): void {
        const { selected } = this.store.state;
        this.orbit = null;
        this.root.classList.toggle("none", selected < 0);
        if (selected < 0) {
            this.numbers.replaceChildren();
            this.start.replaceChildren();
            this.which.textContent =
                this.solutions.count === 0
                    ? "No periodic solution is stored."
                    : "Click on a solution of the diagram, or press an arrow key.";
            [...this.orbitParts, this.multipliers.root].forEach((part) => (part.hidden = true));
            this.root.dataset["orbit"] = "";
            return;
        }
        const rows = numbersOf(this.meta, this.solutions, selected);
        this.numbers.replaceChildren(
            ...rows.flatMap(([name, text]) => [element("dt", {}, [name]), element("dd", {}, [text])]),
        );
        this.showStart(selected);
        this.showMultipliers(selected);
        const place = nearestOrbit(this.meta, this.solutions, selected);
        this.orbitParts.forEach((part) => (part.hidden = place < 0));
        if (place < 0) {
            this.which.textContent = "No orbit of this branch is on this page.";
            this.root.dataset["orbit"] = "";
            return;
        }
        this.text ??= orbitText();
        const orbit = readOrbit(this.meta, this.solutions, this.text, this.places, place);
        this.orbit = orbit;
        this.which.textContent = this.whichOrbit(selected, orbit.solution);
        this.plots.show(orbit);
        this.animation.show(orbit, this.solutions.frequency[orbit.solution] ?? 1);
        this.root.dataset["orbit"] = String(orbit.solution);
    }

    /** How a run starts at a special point. */
    private showStart(selected: number): void {
        const number = this.numbersOfEvents.get(selected);
        if (number === undefined) {
            this.start.replaceChildren();
            return;
        }
        const from = `${this.meta.folder || "RESULTS"}:${number}`;
        const command = `hammerbeam run STUDY.toml --from ${from} --out NEW`;
        const copy = button(
            "Copy command",
            "Copy a command that starts branches of a study at this point",
            () => this.copy(command),
        );
        this.start.replaceChildren(
            `Special point ${number}. A study, also one with changed parameters, starts here by `,
            element("code", {}, [command]),
            " ",
            copy,
        );
    }

    private showMultipliers(selected: number): void {
        this.multipliers.root.hidden = false;
        const whose = `of the selected solution, at ${hertz(this.solutions.frequency[selected] ?? NaN)}`;
        this.multipliers.show(
            this.multipliersOf(selected),
            whose,
            this.table === null ? -1 : this.meta.multipliers.most,
        );
    }

    /** Takes the multipliers of all solutions in, when they are decoded. */
    take(table: MultiplierTable): void {
        this.table = table;
        if (this.store.state.selected >= 0) {
            this.showMultipliers(this.store.state.selected);
        }
    }

    /** Multipliers of a solution, largest first; none before they are decoded. */
    multipliersOf(solution: number): Multiplier[] {
        return this.table?.of(solution) ?? [];
    }

    /** Radii of the unit circle along both axes (canvas pixels). */
    unitCircle(): [number, number] {
        return this.multipliers.unitCircle();
    }

    private whichOrbit(selected: number, shown: number): string {
        const frequency = hertz(this.solutions.frequency[shown] ?? NaN);
        const orbits = this.meta.orbits.solutions.length;
        const carried = `The page carries ${orbits} orbits of ${this.solutions.count} solutions.`;
        if (shown === selected) {
            return `Shown: the orbit of this solution. ${carried}`;
        }
        const steps = Math.abs(shown - selected);
        const away = `${steps} ${steps === 1 ? "solution" : "solutions"} away along the branch`;
        const orbit = `Shown: the orbit of the solution at ${frequency}, the nearest of those carried`;
        return `${orbit}, ${away}. ${carried}`;
    }
}
