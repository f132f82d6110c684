// Puts the parts of the page together. The simulation itself runs in the worker.
import "./style.css";
import "./panels.css";
import {followAddress, newSeed, readAddress} from "./address";
import {Curve} from "./curve";
import {Dish} from "./dish";
import {experiments} from "./experiments";
import {Discovery} from "./discovery";
import {Explorer} from "./explorer";
import {buildGallery} from "./gallery";
import {Laboratory} from "./laboratory";
import {hostOf} from "./host";
import {Lesson} from "./lesson";
import {byId} from "./page";
import {OpenedFile} from "./opened_file";
import {Parameters} from "./parameters";
import {Player} from "./player";
import {Profile} from "./profile";
import {Share} from "./share";
import {addShortcuts} from "./shortcuts";
import {isEmbedded} from "./start";
import {translatePage} from "./texts";
import {Transport} from "./transport";
import {Verdict} from "./verdict";

translatePage();
document.body.classList.toggle("embedded", isEmbedded());

const lab = new Laboratory();
const verdict = new Verdict(lab);
const dish = new Dish(lab, (text) => verdict.say(text));
const player = new Player(lab, dish, matchMedia("(prefers-reduced-motion: reduce)").matches);
const transport = new Transport(lab, dish, player);
const parameters = new Parameters(lab);
new Curve(lab);
new Share(lab, dish);
const host = hostOf(lab, player, transport);
const discovery = new Discovery(byId("discovery"), host, (message) => showError(message));
const explorer = new Explorer(byId("explorer"), host);
const lesson = new Lesson(byId("lesson"), byId("lesson-start"), byId("panels"), host, (message) => showError(message));
const lessonButton = byId("lesson-open") as HTMLButtonElement;
lessonButton.disabled = true; // until the page has read the parameters in its address, which would replace the lesson's
lab.on("ready", () => { lessonButton.disabled = false; });
new OpenedFile(byId("controls"), byId("options"), host, (message) => showError(message));
for (const kind of ["started", "changed"] as const) lab.on(kind, () => { if (lab.missing === 0) discovery.visit(); });
lab.on("averages", (rotation) => discovery.follow(rotation));
lab.on("ready", () => explorer.parametersKnown());
byId("options").append(...experiments(lab, dish, player, transport));
addShortcuts(lab, player, transport);

const error = byId("error");
/** Shows a message below the parameter whose value is wrong, or at the top. */
function showError(message: string, parameter?: string): void {
    const row = parameters.rowOf(parameter);
    if (row) row.append(error);
    else byId("top").after(error);
    error.textContent = message;
    error.hidden = false;
}
lab.on("error", showError);
lab.on("begin", () => { error.hidden = true; });

let isFirst = false; // frame of a simulation
let isExact = false; // the address asks for an event, so time stops there
lab.on("begin", () => { isFirst = true; });
lab.on("frame", () => {
    if (!isFirst) return;
    isFirst = false;
    if (isExact) player.setPlaying(false);
    else player.lapseByItself();
    isExact = false;
});
lab.on("ready", () => {
    dish.layOut();
    const address = readAddress(lab);
    if (address) {
        // Each new visitor sees another run; a link keeps its own.
        lab.given = Object.keys(address.given).length > 0 || address.events > 0 ? address.given : {seed: newSeed()};
        discovery.changed = lesson.changed = followAddress(lab, () => discovery.fragment());
        isExact = address.events > 0;
        lab.begin(address.events);
        lesson.open();
    }
    discovery.readLink();
    buildGallery(lab, (given) => lab.set(lab.withSeed(given), {all: true, restart: true}));
    player.start();
});

const profile = new Profile(lab);
dish.needsMaps = (): boolean => profile.panel.open;
byId("profile").replaceChildren(profile.panel);
