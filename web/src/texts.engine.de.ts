// Die Fehlermeldungen des Programms, die auf der Seite erscheinen können, auf Deutsch. Eine Meldung ohne Regel
// bleibt englisch. Ein Test prüft, dass die Zahlen erhalten bleiben.

import {labelled} from "./symbols";

const rules: [RegExp, string][] = [
    [/^(\d+) \w+ do(?:es)? not fit into a container of radius (\S+): no .*more than (\d+)\.$/,
     "$1 Körper passen nicht in eine Schale vom Radius $2; mehr als $3 haben darin nicht Platz."],
    [/^(\d+) \w+ do(?:es)? not fit into a container of radius (\S+): together they would cover (\d+) % of it\.$/,
     "$1 Körper passen nicht in eine Schale vom Radius $2: Zusammen würden sie $3 % davon bedecken."],
    [/^(\d+) \w+ of .* could not be placed in a container of radius (\S+) .*$/,
     "Für $1 Körper fand sich in einer Schale vom Radius $2 keine Anordnung ohne Überlappung."],
    [/^a \w+ of radius (\S+) does not fit into a container of radius (\S+): .*$/,
     "Ein Körper vom Radius $1 passt nicht in eine Schale vom Radius $2."],
    [/^(.+) is '?(.*?)'?, but it must be a number from (\S+) to (\S+)\.$/, "$1 ist $2, muss aber eine Zahl von $3 bis $4 sein."],
    [/^(.+) is '?(.*?)'?, but it must be a whole number from (\S+) to (\S+)\.$/, "$1 ist $2, muss aber eine ganze Zahl von $3 bis $4 sein."],
    [/^(.+) is '(.*)', but it must be a finite number, for example (\S+) or (\S+)\.$/,
     "$1 ist '$2', muss aber eine Zahl sein, zum Beispiel $3 oder $4."],
    [/^(.+) is '(.*)', but it must be a whole number below (\S+), for example (\S+) or (\S+)\.$/,
     "$1 ist '$2', muss aber eine ganze Zahl unter $3 sein, zum Beispiel $4 oder $5."],
    [/^(.+) is '(.*)', but it must be a whole number of periods, for example (\S+), or auto\.$/,
     "$1 ist '$2', muss aber eine ganze Zahl von Umläufen sein, zum Beispiel $3, oder auto."],
    [/^(.+) is '(.*)', but it must be 0 or more\.$/, "$1 ist '$2', darf aber nicht kleiner als 0 sein."],
    [/^(.+) is '(.*)', but it must be none or sliding: .*$/, "$1 ist '$2', muss aber none oder sliding sein."],
    [/^(--mixture) is '(.*)', but it must be (\S+) or (\S+), for example (\S+) .* or (\S+) .*\.$/,
     "$1 ist '$2', muss aber die Form $3 oder $4 haben (Anzahl, Radius, Masse), zum Beispiel $5, oder $6 für einen Anteil."],
    [/^(.+) is '(.*)', but it must be (\S+(?:, \S+)*) or (\S+)\.$/, "$1 ist '$2', muss aber $3 oder $4 sein."],
    [/^(.+) is '(.*)', but it must be (\S+)\.$/, "$1 ist '$2', muss aber $3 sein."],
    [/^--sides is (\S+), but --path circle has no sides\.$/, "--sides ist $1, aber ein Kreis hat keine Ecken."],
    [/^--path is circle, but on it .*$/,
     "Auf einer Kreisbahn ändert die Reibung am Boden ihre Richtung, während ein Körper gleitet; das kann das Programm nicht berechnen."],
    [/^(\S+) is (\S+), but there is no floor\.$/, "$1 ist $2, aber es gibt keinen Boden."],
    [/^(\S+) is (\S+), but discs do not .*$/, "$1 ist $2, wirkt aber nur auf Kugeln."],
    [/^--rolling-resistance is (\S+), but it must not exceed --floor-friction, (\S+): .*$/,
     "--rolling-resistance ist $1, aber höchstens --floor-friction $2 ist möglich: Sonst gleiten die Kugeln."],
    [/^--speed is (\S+), but --amplitude (\S+) and --period (\S+) give a speed of (\S+)\.$/,
     "--speed ist $1, aber aus --amplitude $2 und --period $3 folgt $4."],
    [/^the last (\d+) events took only (\S+) periods \(collapse after (\S+) periods\): with restitution (\S+) .*$/,
     "Kollaps nach $3 Umläufen: Die letzten $1 Ereignisse brauchten nur $2 Umläufe. Mit der Stoßzahl $4 stoßen die Körper " +
         "immer schneller (inelastischer Kollaps)."],
    [/^the last (\d+) events took no measurable time \(collapse after (\S+) periods\): with restitution (\S+) .*$/,
     "Kollaps nach $2 Umläufen: Die letzten $1 Ereignisse brauchten keine messbare Zeit. Mit der Stoßzahl $3 stoßen die Körper " +
         "immer schneller (inelastischer Kollaps)."],
    [/^the last (\d+) events took only (\S+) periods \(collapse after (\S+) periods\): friction .*$/,
     "Kollaps nach $3 Umläufen: Die letzten $1 Ereignisse brauchten nur $2 Umläufe. Reibung hat die Bewegung aneinander " +
         "gepresster Körper aufgezehrt, und sie stoßen immer schneller (Reibungskollaps)."],
    [/^the last (\d+) events took no measurable time \(collapse after (\S+) periods\): friction .*$/,
     "Kollaps nach $2 Umläufen: Die letzten $1 Ereignisse brauchten keine messbare Zeit. Reibung hat die Bewegung aneinander " +
         "gepresster Körper aufgezehrt, und sie stoßen immer schneller (Reibungskollaps)."],
    [/^this path has no M-frame, .*$/, "Diese Bahn hat kein M-System, das die Seite braucht."],
    // Hinweise
    [/^use fewer \w+ or a larger --container-radius\.$/, "Nimm weniger Körper oder eine größere Schale."],
    [/^did you mean '(.*)'\?$/, "Meintest du '$1'?"],
    [/^a large --floor-friction, (\S+) .*$/, "Eine große --floor-friction wie $1 wirkt genauso."],
    [/^omit one of .*$/, "Lass einen der Werte weg."],
    [/^add --floor sliding\.$/, "Setze --floor auf sliding."],
    [/^add --body sphere\.$/, "Setze --body auf sphere."],
    [/^use --path polygon\.$/, "Setze --path auf polygon."],
    [/^use a --contact-duration longer than (\S+)\.$/, "Nimm eine --contact-duration über $1."],
    [/^another --seed than (\S+) may avoid it\.$/, "Mit einer anderen --seed als $1 geschieht es vielleicht nicht."],
];

const translatedLine = (line: string): string => {
    const [, hint, text] = /^(hint: )?(.*)$/.exec(line)!, rule = rules.find(([pattern]) => pattern.test(text!));
    return rule ? (hint ? "Tipp: " : "") + text!.replace(...rule) : line;
};

/** The message in German. Options are written as the names of their fields. */
export const translated = (message: string, labels: Record<string, string>): string =>
    labelled(message.split("\n").map(translatedLine).join("\n"), labels, false).replace(/(\d)\.(?=\d)/g, "$1,");
