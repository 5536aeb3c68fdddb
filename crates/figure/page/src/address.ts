// The address of the page, kept in step with what is shown.

/** How long (ms) changes are gathered before they are written into the address. */
const PATIENCE = 200;

export class Address {
    /** What the address was when it was last read or written. */
    private known = location.hash;
    private planned = 0;

    /**
     * * `current`: the part behind # for what is shown.
     * * `follow`: shows what a link leads to.
     */
    constructor(private readonly current: () => string, private readonly follow: (hash: string) => void) {
        window.addEventListener("hashchange", () => this.read());
    }

    /** Writes soon, once for all that changes until then. */
    plan(): void {
        if (this.planned === 0) {
            this.planned = window.setTimeout(() => this.write(), PATIENCE);
        }
    }

    /**
     * Writes now, without a new entry of the history.
     *
     * A link that was typed since is followed first: the browser tells of it later than the address has it,
     * and would not tell at all once it is overwritten.
     */
    write(): void {
        this.read();
        window.clearTimeout(this.planned);
        this.planned = 0;
        history.replaceState(null, "", this.current());
        this.known = location.hash;
    }

    private read(): void {
        if (location.hash !== this.known) {
            this.known = location.hash;
            this.follow(this.known);
        }
    }
}
