// Opens other results to compare with: by a choice of files, or dropped onto the diagram.

import { readCompared, type Compared } from "./compared";
import type { Meta } from "./data";
import type { Saying } from "./saying";

export class Others {
    readonly list: Compared[] = [];

    constructor(
        private readonly meta: Meta,
        private readonly saying: Saying,
        private readonly changed: () => void,
    ) {}

    /** Opens files, and says what cannot be read. */
    async open(files: readonly Pick<File, "name" | "text">[]): Promise<void> {
        const failed: string[] = [];
        for (const file of files) {
            try {
                this.list.push(await readCompared(file.name, await file.text(), this.meta));
            } catch (error) {
                failed.push(`${file.name}: ${error instanceof Error ? error.message : String(error)}.`);
            }
        }
        if (failed.length > 0) {
            this.saying.say(failed.join(" "));
        }
        this.changed();
    }

    /** Opens what is dropped onto an element. */
    takeDropsOn(target: HTMLElement): void {
        target.addEventListener("dragover", (event) => event.preventDefault());
        target.addEventListener("drop", (event) => {
            event.preventDefault();
            void this.open([...(event.dataTransfer?.files ?? [])]);
        });
    }
}
