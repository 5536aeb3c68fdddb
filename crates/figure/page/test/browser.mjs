// A headless Chromium, driven over a pipe by the DevTools protocol. No more is needed of it than what is here.
//
// The browser is the one named by HAMMERBEAM_BROWSER, else one that is installed, else that of the package in package-lock.json, unpacked when it is
// first needed. Where none starts the reason is told: the test says that it was skipped, or fails where HAMMERBEAM_REQUIRE_BROWSER=1.

import { spawn } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, renameSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { delimiter, join } from "node:path";

const NAMES = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome-headless-shell", "chromium-headless-shell"];
const PATIENCE_MS = 60_000;
/** A hint about reading pixels, which a test does and the page does not. */
const OF_THE_TEST = /readback operations using getImageData/;

/** Paths of browsers, those to be tried first at first. */
async function* candidates() {
    if (process.env.HAMMERBEAM_BROWSER) {
        yield process.env.HAMMERBEAM_BROWSER;
    }
    for (const folder of (process.env.PATH ?? "").split(delimiter)) {
        for (const name of NAMES) {
            if (folder !== "" && existsSync(join(folder, name))) {
                yield join(folder, name);
            }
        }
    }
    const packed = await import("@sparticuz/chromium").catch(() => null);
    if (packed !== null) {
        yield await unpacked(packed.default);
    }
}

/** The browser of the package, unpacked beside it once; a half-finished one is never used. */
async function unpacked(packed) {
    const cache = join(import.meta.dirname, "..", "node_modules", ".cache");
    const [done, doing] = [join(cache, "chromium"), join(cache, `unpacking-${process.pid}`)];
    if (!existsSync(join(done, "chromium"))) {
        mkdirSync(doing, { recursive: true });
        const before = process.env.TMPDIR;
        process.env.TMPDIR = doing; // where the package unpacks
        packed.setGraphicsMode = false;
        await packed.executablePath();
        before === undefined ? delete process.env.TMPDIR : (process.env.TMPDIR = before);
        try {
            renameSync(doing, done);
        } catch {
            rmSync(doing, { recursive: true, force: true }); // another process was faster
        }
    }
    return join(done, "chromium");
}

/** Starts a browser; throws with the reasons where none can be had. */
export async function launch() {
    const reasons = [];
    try {
        for await (const path of candidates()) {
            try {
                return await Browser.start(path);
            } catch (error) {
                reasons.push(`${path}: ${error.message}`);
            }
        }
    } catch (error) {
        reasons.push(error.message);
    }
    throw new Error(reasons.length > 0 ? reasons.join("; ") : "no browser is installed, and the packages of package-lock.json are not (npm ci)");
}

export class Browser {
    #process;
    #profile;
    #waiting = new Map();
    #listeners = [];
    #number = 0;
    #rest = "";
    #tabs = [];

    static async start(path) {
        const browser = new Browser();
        browser.#profile = mkdtempSync(join(tmpdir(), "hammerbeam-page-"));
        const options = ["--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--remote-debugging-pipe", "--allow-file-access-from-files"];
        browser.#process = spawn(path, [...options, `--user-data-dir=${browser.#profile}`, "about:blank"], { env: { ...process.env, LANG: "en_US.UTF-8", LC_ALL: "en_US.UTF-8", LANGUAGE: "en_US" }, stdio: ["ignore", "ignore", "pipe", "pipe", "pipe"] });
        let complaints = "";
        browser.#process.stderr.on("data", (part) => (complaints += part));
        browser.#process.stdio[3].on("error", () => {});
        browser.#process.stdio[4].setEncoding("utf8").on("data", (part) => browser.#read(part));
        const gone = new Promise((_, reject) => {
            browser.#process.once("error", reject);
            browser.#process.once("exit", (code) => {
                const error = new Error(`the browser ended (${code}): ${complaints.trim().split("\n").at(-1)}`);
                browser.#waiting.forEach(({ reject: refuse }) => refuse(error));
                reject(error);
            });
        });
        gone.catch(() => {});
        await Promise.race([browser.send("Browser.getVersion"), gone]);
        return browser;
    }

    #read(part) {
        const messages = (this.#rest + part).split("\0");
        this.#rest = messages.pop();
        for (const text of messages) {
            const message = JSON.parse(text);
            const waiting = this.#waiting.get(message.id);
            if (waiting === undefined) {
                this.#listeners.forEach((listener) => listener(message));
            } else {
                this.#waiting.delete(message.id);
                clearTimeout(waiting.timer);
                message.error ? waiting.reject(new Error(message.error.message)) : waiting.resolve(message.result);
            }
        }
    }

    send(method, params = {}, sessionId = undefined) {
        const id = ++this.#number;
        return new Promise((resolve, reject) => {
            const timer = setTimeout(() => reject(new Error(`${method}: no answer`)), PATIENCE_MS);
            this.#waiting.set(id, { resolve, reject, timer });
            this.#process.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId })}\0`);
        });
    }

    listen(listener) {
        this.#listeners.push(listener);
    }

    /** A new tab of a size. */
    async tab(width = 1400, height = 1000, features = []) {
        const { targetId } = await this.send("Target.createTarget", { url: "about:blank" });
        const { sessionId } = await this.send("Target.attachToTarget", { targetId, flatten: true });
        this.#tabs.push(targetId);
        const tab = new Tab(this, sessionId);
        for (const domain of ["Page", "Runtime", "Log"]) {
            await tab.send(`${domain}.enable`);
        }
        await tab.send("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: false });
        await tab.send("Emulation.setEmulatedMedia", { features });
        return tab;
    }

    /** Closes every tab. */
    async closeTabs() {
        await Promise.all(this.#tabs.splice(0).map((targetId) => this.send("Target.closeTarget", { targetId })));
    }

    async close() {
        const gone = new Promise((resolve) => this.#process.once("exit", resolve));
        const timer = setTimeout(() => this.#process.kill("SIGKILL"), 5000);
        await this.send("Browser.close").catch(() => {});
        await gone;
        clearTimeout(timer);
        rmSync(this.#profile, { recursive: true, force: true, maxRetries: 5 });
    }
}

class Tab {
    /** Errors and warnings of the page. */
    complaints = [];
    #browser;
    #session;
    #loaded = [];

    constructor(browser, session) {
        this.#browser = browser;
        this.#session = session;
        browser.listen(({ method, params, sessionId }) => {
            if (sessionId !== session) {
                return;
            }
            if (method === "Runtime.exceptionThrown") {
                const { text, exception } = params.exceptionDetails;
                this.complaints.push(`${text} ${exception?.description ?? ""}`);
            } else if (method === "Runtime.consoleAPICalled" && ["error", "warning", "assert"].includes(params.type)) {
                this.complaints.push(params.args.map((argument) => argument.value ?? argument.description).join(" "));
            } else if (method === "Log.entryAdded" && ["error", "warning"].includes(params.entry.level) && !OF_THE_TEST.test(params.entry.text)) {
                this.complaints.push(params.entry.text);
            } else if (method === "Page.loadEventFired") {
                this.#loaded.splice(0).forEach((resolve) => resolve());
            }
        });
    }

    send(method, params) {
        return this.#browser.send(method, params, this.#session);
    }

    async open(url) {
        const loaded = new Promise((resolve) => this.#loaded.push(resolve));
        await this.send("Page.navigate", { url });
        await loaded;
    }

    /** The value of an expression in the page; promises are waited for. */
    async value(expression) {
        const { result, exceptionDetails } = await this.send("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
        if (exceptionDetails) {
            throw new Error(`${expression}: ${exceptionDetails.exception?.description ?? exceptionDetails.text}`);
        }
        return result.value;
    }

    /** Waits until an expression is true. */
    async until(expression, patience = 10_000) {
        const end = Date.now() + patience;
        while (!(await this.value(expression))) {
            if (Date.now() > end) {
                throw new Error(`never true: ${expression}`);
            }
            await new Promise((resolve) => setTimeout(resolve, 30));
        }
    }

    async mouse(type, x, y, more = {}) {
        await this.send("Input.dispatchMouseEvent", { type, x, y, button: "left", clickCount: 1, ...more });
    }

    async click(x, y) {
        await this.mouse("mouseMoved", x, y, { button: "none" });
        await this.mouse("mousePressed", x, y, { buttons: 1 });
        await this.mouse("mouseReleased", x, y);
    }

    async press(key) {
        const text = key.length === 1 ? { text: key } : {};
        await this.send("Input.dispatchKeyEvent", { type: "keyDown", key, ...text });
        await this.send("Input.dispatchKeyEvent", { type: "keyUp", key });
    }

    /** A picture of what is seen, or of the whole page, as PNG. */
    async picture(whole = false) {
        const { data } = await this.send("Page.captureScreenshot", { format: "png", captureBeyondViewport: whole });
        return Buffer.from(data, "base64");
    }
}
