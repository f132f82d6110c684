// The menu for saving and sharing, and the command that reproduces the state.
import type {Dish} from "./dish";
import {icon} from "../elements/icons";
import type {Laboratory} from "../engine/laboratory";
import {
    button,
    byId,
    canvasFont,
    element,
    paper,
    quiet,
    save,
    withElements,
} from "../elements/page";
import {Recording} from "./recording";
import {tableOf} from "../engine/series";
import {pageEntries} from "../texts/start";
import {texts} from "../texts/texts";
import {encode} from "uqr";

/** The address of the page with the given parameters, in the language that was chosen. */
export function addressOf(given: Record<string, string>): string {
    const query = new URLSearchParams({...given, ...pageEntries}),
        text = query.toString();
    return text ? `?${text}` : location.pathname;
}

/** The containers side by side, as a picture with the address below it; that of a local file has no
 *  folders. */
function pictureOf(address: string): string {
    const shown = [...byId("views").querySelectorAll("canvas")],
        canvas = element("canvas"),
        row = 22 * (devicePixelRatio || 1);
    canvas.width = shown.reduce((sum, {width}) => sum + width, 0);
    canvas.height = Math.max(...shown.map(({height}) => height)) + row;
    const context = canvas.getContext("2d")!;
    context.fillStyle = paper();
    context.fillRect(0, 0, canvas.width, canvas.height);
    let left = 0;
    for (const each of shown) {
        context.drawImage(each, left, 0);
        left += each.width;
    }
    context.fillStyle = quiet();
    context.font = canvasFont(400, 0.55 * row);
    context.fillText(address, 0.4 * row, canvas.height - 0.4 * row, canvas.width - 0.8 * row);
    return canvas.toDataURL("image/png");
}

/** Shows a link as a QR code, dark on light whatever the theme. */
export function showCode(link: string): void {
    const content = element("div", {id: "qr"});
    try {
        const {size, data} = encode(link, {ecc: "L", border: 4}),
            scale = Math.max(2, Math.floor(320 / size));
        const canvas = element("canvas", {width: scale * size, height: scale * size}),
            context = canvas.getContext("2d")!;
        canvas.setAttribute("role", "img");
        canvas.setAttribute("aria-label", link);
        context.fillStyle = "#fff";
        context.fillRect(0, 0, canvas.width, canvas.height);
        context.fillStyle = "#000";
        for (const [y, row] of data.entries())
            for (const [x, isDark] of row.entries())
                if (isDark) context.fillRect(scale * x, scale * y, scale, scale);
        content.append(canvas);
    } catch {
        content.append(element("p", {textContent: texts.qrTooLong}));
    }
    const dialog = element(
        "dialog",
        {},
        content,
        element("code", {textContent: link}),
        button(texts.close, () => dialog.close()),
    );
    dialog.setAttribute("aria-label", texts.qr);
    dialog.addEventListener("close", () => dialog.remove());
    document.body.append(dialog);
    dialog.showModal();
}

export class Share {
    private readonly recording: Recording;
    private readonly command = element("code", {id: "command"});
    private readonly copies = button(
        texts.copy,
        () => void this.copy(this.command.textContent ?? "", this.copies, texts.copy),
        "copy",
    );

    constructor(
        private readonly lab: Laboratory,
        dish: Dish,
    ) {
        this.recording = new Recording(() => dish.canvas);
        dish.laidOut = (): void => this.recording.stop();
        const events = element("span", {id: "event-count"}),
            hash = element("code", {id: "state-hash"});
        const address = (): string => new URL(addressOf(lab.given), location.href).href;
        const link = button(
            texts.link,
            () => void this.copy(address(), link, texts.link),
            "copy-link",
        );
        // The reader may close the dialog of the system, which rejects.
        const send = button(
            texts.send,
            () => void navigator.share({title: document.title, url: address()}).catch(() => {}),
            "send-link",
        );
        link.hidden = location.protocol === "about:"; // a frame in a notebook has no address
        const code = button(texts.qr, () => showCode(address() + location.hash), "show-qr");
        code.hidden = link.hidden;
        send.hidden = link.hidden || !("share" in navigator);
        const menu = element(
            "details",
            {},
            element(
                "summary",
                {title: texts.share},
                icon("share"),
                element("span", {textContent: texts.share}),
            ),
            element(
                "div",
                {className: "menu"},
                link,
                send,
                code,
                button(
                    texts.image,
                    () => save("swirl.png", {href: pictureOf(address().replace(/^file:.*\//, ""))}),
                    "save-image",
                ),
                button(
                    texts.table,
                    () => save("rotation.csv", {text: tableOf(lab.averages), type: "text/csv"}),
                    "save-table",
                ),
                button(texts.result, () => lab.send({kind: "result"}), "save-result"),
                this.recording.panel,
                element("p", {textContent: texts.commandLine}),
                this.command,
                this.copies,
                element("p", {}, ...withElements(texts.stateHash, {events, hash})),
            ),
        );
        byId("share").replaceChildren(menu);
        menu.addEventListener("keydown", (event) => {
            if (event.key !== "Escape") return;
            menu.open = false;
            menu.querySelector("summary")?.focus();
        });
        document.addEventListener("pointerdown", (event) => {
            if (!menu.contains(event.target as Node)) menu.open = false;
        });
        lab.on("begin", () => {
            this.recording.stop();
            for (const ofState of [events, hash]) ofState.textContent = "";
            this.offerCommand();
        });
        lab.on("error", () => this.offerCommand());
        lab.on("changed", () => this.offerCommand());
        lab.on("frame", (frame) => {
            events.textContent = String(frame.events);
            hash.textContent = frame.hash;
            this.offerCommand(frame.command);
        });
        lab.on("result", (text) =>
            save("result.json", {
                text: JSON.stringify(JSON.parse(text), null, 2) + "\n",
                type: "application/json",
            }),
        );
        this.offerCommand();
    }

    async copy(text: string, from: HTMLButtonElement, label: string): Promise<void> {
        try {
            await navigator.clipboard.writeText(text);
        } catch {
            prompt(label, text); // a browser without the clipboard, for example without https
            return;
        }
        from.textContent = texts.copied;
        setTimeout(() => {
            from.textContent = label;
        }, 2000);
    }

    /** Without a running simulation there is no command. */
    private offerCommand(command = ""): void {
        this.command.textContent = this.lab.wasChanged ? texts.noCommand : command;
        this.copies.disabled = this.lab.wasChanged || command === "";
    }
}
