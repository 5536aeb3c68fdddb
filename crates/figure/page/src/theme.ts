// Dark and light: the colours in use, as the system or the reader asks for. Paper is light, and of its own
// width.

import type { Look, Meta } from "./data";
import type { Store } from "./state";

const system = window.matchMedia("(prefers-color-scheme: dark)");
const print = window.matchMedia("print");

export class Theme {
    look: Look;
    private readonly listeners: (() => void)[] = [];
    private prints = false;

    constructor(private readonly meta: Meta, private readonly store: Store) {
        this.look = meta.look.light;
        this.choose();
        system.addEventListener("change", () => this.change());
        print.addEventListener("change", () => this.change());
        window.addEventListener("beforeprint", () => this.print(true));
        window.addEventListener("afterprint", () => this.print(false));
        store.listen((_, changed) => {
            if (changed.has("theme")) {
                this.change();
            }
        });
    }

    /** Whether the page is laid out for paper: a browser says so before its media are those of print. */
    get printing(): boolean {
        return this.prints || print.matches;
    }

    get dark(): boolean {
        const { theme } = this.store.state;
        return !this.printing && (theme === "dark" || (theme === "auto" && system.matches));
    }

    listen(listener: () => void): void {
        this.listeners.push(listener);
    }

    period(period: number): string {
        const colours = this.look.periods;
        return colours[(Math.max(1, period) - 1) % colours.length] ?? this.look.ink;
    }

    /** Number of strokes across the lines of a period, which tell it where colours do not. */
    strokes(period: number): number {
        const { strokes } = this.look;
        return strokes[(Math.max(1, period) - 1) % strokes.length] ?? 0;
    }

    private print(prints: boolean): void {
        this.prints = prints;
        this.change();
    }

    private change(): void {
        this.choose();
        this.listeners.forEach((listener) => listener());
    }

    private choose(): void {
        this.look = this.dark ? this.meta.look.dark : this.meta.look.light;
        const root = document.documentElement;
        root.dataset["theme"] = this.dark ? "dark" : "light";
        root.toggleAttribute("data-printing", this.printing);
        for (const name of ["ink", "pale", "grid", "paper", "panel", "shade"] as const) {
            root.style.setProperty(`--${name}`, this.look[name]);
        }
        root.style.setProperty("--accent", this.look.periods[1] ?? this.look.ink);
        root.style.setProperty("--first", this.look.periods[0] ?? this.look.ink);
    }
}
