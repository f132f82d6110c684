// The icons of the page, as paths in a square of 24 units.
const paths = {
    play: "M8 5v14l11-7z",
    pause: "M7 5h3.5v14H7zM13.5 5H17v14h-3.5z",
    restart: "M12 5V1.8L7.2 6.4 12 11V7.6a5 5 0 1 1-5 5H4.4A7.6 7.6 0 1 0 12 5z",
    share: "M12 3l4.5 4.5-1.4 1.4L13 6.8V15h-2V6.8L8.9 8.9 7.5 7.5zM5 13h2v6h10v-6h2v8H5z",
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
