// A table whose rows are sorted by a press on the head of a column, filtered by words, and made as many as
// are read.

import { element } from "./dom";

/** Rows that are made at a time. */
const ROWS = 150;

export interface Column<Row> {
    head: string;
    /** What a reader sees in a cell. */
    cell: (row: Row) => string | Node;
    /** By what rows are sorted; without it they are not. */
    by?: (row: Row) => number | string;
}

export class Table<Row> {
    readonly root: HTMLElement;
    /** How many rows there are, in words. */
    readonly count = element("span", { class: "note", role: "status" });
    readonly filter: HTMLElement;
    private readonly body = element("tbody");
    private readonly heads: HTMLElement[];
    private readonly more = element("button", { type: "button" }, ["more rows"]);
    private rows: readonly Row[] = [];
    private words: string[] = [];
    private most = ROWS;
    private sorted: { column: number; falls: boolean };

    /**
     * * `first`: the column by which rows are sorted at first.
     * * `finish`: what a row has besides its cells.
     */
    constructor(
        private readonly columns: readonly Column<Row>[],
        first: number,
        private readonly finish: (made: HTMLElement, row: Row) => void,
        hint: string,
    ) {
        this.sorted = { column: first, falls: false };
        this.heads = columns.map(({ head, by }, column) => {
            const cell = element("th", { scope: "col" }, by === undefined ? [head] : []);
            if (by !== undefined) {
                const press = element("button", { type: "button", title: `Sort by ${head}` }, [head]);
                press.addEventListener("click", () => this.sort(column));
                cell.append(press);
            }
            return cell;
        });
        const box = element("input", {
            type: "search",
            placeholder: "filter",
            "aria-label": hint,
            title: hint,
        });
        box.addEventListener("input", () => {
            this.words = box.value
                .toLowerCase()
                .split(/\s+/)
                .filter((word) => word !== "");
            this.most = ROWS;
            this.fill();
        });
        this.filter = box;
        this.more.addEventListener("click", () => {
            this.most += ROWS;
            this.fill();
        });
        const table = element("table", {}, [
            element("thead", {}, [element("tr", {}, this.heads)]),
            this.body,
        ]);
        this.root = element("div", { class: "scroll", tabindex: "0" }, [table, this.more]);
    }

    show(rows: readonly Row[]): void {
        this.rows = rows;
        this.fill();
    }

    private sort(column: number): void {
        this.sorted = { column, falls: this.sorted.column === column && !this.sorted.falls };
        this.fill();
    }

    private text(row: Row): string {
        return this.columns
            .map(({ cell }) => {
                const made = cell(row);
                return typeof made === "string" ? made : (made.textContent ?? "");
            })
            .join(" ")
            .toLowerCase();
    }

    private fill(): void {
        const { column, falls } = this.sorted;
        const by = this.columns[column]?.by ?? (() => 0);
        const kept =
            this.words.length === 0
                ? [...this.rows]
                : this.rows.filter((row) => {
                      const text = this.text(row);
                      return this.words.every((word) => text.includes(word));
                  });
        const compared = (a: number | string, b: number | string): number => (a < b ? -1 : a > b ? 1 : 0);
        kept.sort((a, b) => (falls ? -1 : 1) * compared(by(a), by(b)));
        this.heads.forEach((head, k) =>
            k === column
                ? head.setAttribute("aria-sort", falls ? "descending" : "ascending")
                : head.removeAttribute("aria-sort"),
        );
        this.body.replaceChildren(...kept.slice(0, this.most).map((row) => this.made(row)));
        this.more.hidden = kept.length <= this.most;
        this.count.textContent =
            kept.length > this.most ? `${this.most} of ${kept.length}` : `${kept.length}`;
    }

    private made(row: Row): HTMLElement {
        const made = element(
            "tr",
            {},
            this.columns.map(({ cell }) => element("td", {}, [cell(row)])),
        );
        this.finish(made, row);
        return made;
    }
}
