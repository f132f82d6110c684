// The icons of the page, as paths in a square of 24 units.
const paths = {
    play: "M8 5v14l11-7z",
    pause: "M7 5h3.5v14H7zM13.5 5H17v14h-3.5z",
    step: "M6 5v14l9-7zM16 5h2.5v14H16z",
    restart: "M12 5V1.8L7.2 6.4 12 11V7.6a5 5 0 1 1-5 5H4.4A7.6 7.6 0 1 0 12 5z",
    lapse: "M4 5v14l7.5-7zM12.5 5v14l7.5-7z",
    share: "M12 3l4.5 4.5-1.4 1.4L13 6.8V15h-2V6.8L8.9 8.9 7.5 7.5zM5 13h2v6h10v-6h2v8H5z",
    hand: "M12 3a1.4 1.4 0 0 1 1.4 1.4V10h.6V6a1.3 1.3 0 0 1 2.6 0v5h.6V8a1.2 1.2 0 0 1 2.4 0v7c0 3.6-2.4 6-6 6-2.8 0-4.4-1.2-5.8-3.8L5 12.6c-.8-1.4 1-2.6 2.2-1.4L9.2 13V5.4a1.4 1.4 0 0 1 1.4-1.4z",
    more: "M5 10.2a1.8 1.8 0 1 0 0 3.6 1.8 1.8 0 0 0 0-3.6zm7 0a1.8 1.8 0 1 0 0 3.6 1.8 1.8 0 0 0 0-3.6zm7 0a1.8 1.8 0 1 0 0 3.6 1.8 1.8 0 0 0 0-3.6z",
};
export type Icon = keyof typeof paths;

export function icon(name: Icon): SVGElement {
    const space = "http://www.w3.org/2000/svg";
    const made = document.createElementNS(space, "svg"),
        path = document.createElementNS(space, "path");
    made.setAttribute("viewBox", "0 0 24 24");
    made.setAttribute("aria-hidden", "true");
    path.setAttribute("d", paths[name]);
    made.append(path);
    return made;
}
