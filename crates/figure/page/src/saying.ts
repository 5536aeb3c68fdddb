// What the page says for some seconds at its lower edge.

import { button, element } from "./dom";

const SECONDS = 6;

export class Saying {
    readonly root = element("p", { class: "note said", role: "status" });
    private timer = 0;

    say(...words: (string | Node)[]): void {
        window.clearTimeout(this.timer);
        this.root.replaceChildren(...words);
        this.timer = window.setTimeout(() => this.root.replaceChildren(), 1000 * SECONDS);
    }

    /** Says so with a way to a part of the page, if that is out of sight. */
    pointTo(id: string, words: string): void {
        const panel = document.getElementById(id);
        const box = panel?.getBoundingClientRect();
        if (panel && box && (box.top > window.innerHeight - 200 || box.bottom < 100)) {
            const go = button("Go to it", words, () => {
                panel.scrollIntoView({ block: "nearest" });
                this.root.replaceChildren();
            });
            this.say(words, go);
        }
    }

    /** Copies a text; where the clipboard is closed it says something else, or the text itself. */
    async copy(text: string, done: string, closed = text): Promise<void> {
        try {
            await navigator.clipboard.writeText(text);
            this.say(done);
        } catch {
            this.say(closed);
        }
    }
}
