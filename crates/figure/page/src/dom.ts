// Elements in few words.

type Child = Node | string;

export function element<K extends keyof HTMLElementTagNameMap>(
    tag: K,
    attributes: Record<string, string> = {},
    children: readonly Child[] = [],
): HTMLElementTagNameMap[K] {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) {
        made.setAttribute(name, value);
    }
    made.append(...children);
    return made;
}

export function button(text: string, title: string, pressed: () => void): HTMLButtonElement {
    const made = element("button", { type: "button", title }, [text]);
    made.addEventListener("click", pressed);
    return made;
}

/** A choice of one of several, with a label. */
export function choice<T extends string>(
    label: string,
    options: readonly (readonly [T, string])[],
    chosen: (value: T) => void,
): { root: HTMLElement; show: (value: T) => void } {
    const choices = options.map(([value, text]) => element("option", { value }, [text]));
    const select = element("select", {}, choices);
    select.addEventListener("change", () => {
        const found = options.find(([value]) => value === select.value);
        if (found !== undefined) {
            chosen(found[0]);
        }
    });
    const root = element("label", { class: "choice" }, [label, select]);
    return { root, show: (value) => (select.value = value) };
}

/** A switch with a label. */
export function toggle(
    label: string,
    changed: (on: boolean) => void,
): { root: HTMLElement; show: (on: boolean) => void } {
    const box = element("input", { type: "checkbox" });
    box.addEventListener("change", () => changed(box.checked));
    return { root: element("label", { class: "toggle" }, [box, label]), show: (on) => (box.checked = on) };
}

export function panel(heading: string, id: string, children: readonly Child[]): HTMLElement {
    const title = element("h2", {}, [heading]);
    return element("section", { class: "panel", id, "aria-label": heading }, [title, ...children]);
}
