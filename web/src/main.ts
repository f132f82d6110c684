// Puts the parts of the page together. The simulation itself runs in the worker.
import "./style.css";
import "./panels.css";
import {followAddress, newSeed, readAddress, readBeside} from "./address";
import {CausePanel} from "./panels/cause";
import {Curve} from "./panels/curve";
import {Dish} from "./dish/dish";
import {experiments} from "./panels/experiments";
import {Discovery} from "./panels/discovery";
import {Explorer} from "./panels/explorer";
import {buildGallery} from "./panels/gallery";
import {Laboratory} from "./engine/laboratory";
import {hostOf} from "./dish/host";
import {Lesson} from "./panels/lesson";
import {byId} from "./elements/page";
import {MyDish} from "./panels/my_dish";
import {OpenedFile} from "./panels/opened_file";
import {Parameters} from "./panels/parameters";
import {Player} from "./dish/player";
import {Profile} from "./panels/profile";
import {addressOf, Share} from "./dish/share";
import {addShortcuts} from "./dish/shortcuts";
import {isEmbedded, pageEntry, setPageEntry} from "./texts/start";
import {translatePage} from "./texts/texts";
import {Transport} from "./dish/transport";
import {Verdict} from "./panels/verdict";

translatePage();
document.body.classList.toggle("embedded", isEmbedded());

const lab = new Laboratory();
const verdict = new Verdict(lab);
const dish = new Dish(lab, (text) => verdict.say(text));
verdict.other = () => dish.compared;
const player = new Player(lab, dish, matchMedia("(prefers-reduced-motion: reduce)").matches);
const transport = new Transport(lab, dish, player);
const parameters = new Parameters(lab);
new Curve(lab);
const share = new Share(lab, dish);
const host = hostOf(lab, dish, player, transport);
const discovery = new Discovery(byId("discovery"), host, (message) => showError(message));
const explorer = new Explorer(byId("explorer"), host);
const lesson = new Lesson(byId("lesson"), byId("lesson-start"), byId("panels"), host, (message) =>
    showError(message),
);
const lessonButton = byId("lesson-open") as HTMLButtonElement;
lessonButton.disabled = true; // the parameters in the page's address would replace the lesson's
lab.on("ready", () => {
    lessonButton.disabled = false;
});
new OpenedFile(byId("controls"), byId("options"), host, (message) => showError(message));
for (const kind of ["started", "changed"] as const)
    lab.on(kind, () => {
        if (lab.missing === 0) discovery.visit();
    });
lab.on("averages", (rotation) => discovery.follow(rotation));
// The picture of index.html is shown until both containers have turned, or there is something else
// to see.
const endFirstPicture = (): void => document.getElementById("first")?.remove();
for (const kind of ["changed", "error"] as const) lab.on(kind, endFirstPicture);
lab.on("averages", () => {
    if (verdict.finding.mean !== null && (dish.compared?.finding.mean ?? null) !== null)
        endFirstPicture();
});
dish.comparedChanged = () => {
    setPageEntry("beside", dish.compared?.follows ? dish.compared.given["discs"] : undefined);
    if (dish.compared) discovery.add(dish.compared.given);
    else endFirstPicture();
    (byId("compare") as HTMLButtonElement).disabled = dish.compared !== undefined;
    dish.changed();
};
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
lab.on("warning", (message) => setTimeout(() => showError(message))); // the beginning hides messages
lab.on("begin", () => {
    error.hidden = true;
});

let isFirst = false; // frame of a simulation
let isExact = false; // the address asks for an event, so time stops there
lab.on("begin", () => {
    isFirst = true;
});
lab.on("frame", () => {
    if (!isFirst) return;
    isFirst = false;
    if (isExact) player.setPlaying(false);
    else player.lapse();
    isExact = false;
});
lab.on("ready", () => {
    dish.layOut();
    transport.readAddress();
    const address = readAddress(lab);
    if (address) {
        // Each new visitor sees another run; a link keeps its own.
        const isClass = pageEntry("class") !== null;
        setPageEntry("class", undefined);
        lab.given = isClass
            ? {...address.given, seed: newSeed()}
            : Object.keys(address.given).length > 0 || address.events > 0
              ? address.given
              : {seed: newSeed()};
        discovery.changed =
            lesson.changed =
            dish.changed =
            transport.changed =
                followAddress(lab, () => discovery.fragment());
        dish.changed(); // what the address had and the page does not know
        isExact = address.events > 0;
        const isNew = Object.keys(address.given).length === 0 && address.events === 0;
        const beside = readBeside(lab, isNew),
            {discs: _, ...others} = lab.given;
        if (beside)
            dish.compare({...others, discs: beside}, lab.counted(Number(beside), others), true);
        lab.begin(address.events);
        lesson.open();
    }
    discovery.readLink();
    byId("explorer").after(
        new MyDish(
            host,
            discovery,
            (text, from) => void share.copy(text, from, from.textContent!),
            showError,
            () => {
                const {seed: _, ...given} = lab.given,
                    address = new URL(addressOf(given), location.href);
                address.searchParams.set("class", "1");
                return address.href;
            },
        ).panel,
    );
    buildGallery(lab, (given) => {
        if (dish.compared?.follows) dish.compare();
        lab.set(lab.withSeed(given), {all: true, restart: true});
    });
    player.start();
});

byId("panels").prepend(
    new CausePanel(lab, player.reducedMotion, () => {
        host.show(lab.withSeed({discs: "48"}), {view: "lab", coloring: "contacts", beside: "8"});
        byId("dish").scrollIntoView({block: "nearest"});
    }).panel,
);
const profile = new Profile(lab);
dish.needsMaps = (): boolean => profile.panel.open;
byId("profile").replaceChildren(profile.panel);
