// Die deutschen Texte der Seite, mit denselben Schlüsseln wie texts.en.ts; ein Test vergleicht beide. Die
// Fehlermeldungen des Programms übersetzt texts.engine.de.ts. Namen von Parametern und Schlüssel in Dateien sind in
// beiden Sprachen englisch.

import type {Crossing, Rate} from "./engine";
import {symbols} from "./symbols";
import type * as en from "./texts.en";

const comma = (number: string): string => number.replace(".", ",");

export const pageTexts: typeof en.pageTexts = {
    language: "de",
    title: "Pancake Rotation: warum sich Murmeln in einer geschwenkten Schale rückwärts drehen",
    description: "Schwenke eine Schale: Wenige Murmeln drehen sich im Umlaufsinn, viele rückwärts. Verschiebe den Regler und finde die " +
        "Anzahl, bei der sich die Richtung umkehrt, in einer exakten Simulation.",
    name: "swirl",
    noScript: "Diese Seite braucht JavaScript, das hier ausgeschaltet ist.",
    dish: "Simulierte Schale",
    controls: "Ergebnis und Regler",
    lesson: "Schulstunde",
    gallery: "Beispiele",
    panels: "Weitere Ansichten",
    tagline: "Murmeln in einer geschwenkten Schale drehen sich im Umlaufsinn oder gegensinnig.",
    commandLine: "Die Seite rechnet mit dem Programm, den Parametern und den Mittelwerten der Kommandozeile. Dieser Befehl " +
        "erzeugt exakt denselben Zustand:",
    copy: "Kopieren",
    after: "Nach",
    stateHashIs: "Ereignissen ist die Prüfsumme des Zustands",
};

export const texts: typeof en.texts = {
    play: "Abspielen (Leertaste)",
    pause: "Anhalten (Leertaste)",
    share: "Speichern und teilen",
    link: "Link kopieren",
    send: "Link senden …",
    copy: "Kopieren",
    step: "Nächstes Ereignis (.)",
    lapse: "Vorspulen bis zu den Mittelwerten, ein Bild je Umlauf (F)",
    strobe: "Stroboskop",
    strobeHelp: "Ein Bild je Umlauf: So verschwindet das Schwappen, und die langsame Drehung wird sichtbar (S)",
    restart: "Neu beginnen (R)",
    image: "Bild speichern (PNG)",
    table: "ϖ je Umlauf speichern (CSV)",
    result: "Ergebnis speichern (JSON)",
    record: "Aufnehmen",
    recordStop: "Aufnahme beenden",
    movie: (form: string): string => `Video speichern (${form})`,
    positions: "Orte speichern (XYZ)",
    compare: "Vergleichen",
    compareHelp: "Behält diese Schale auf der Seite, neben einer neuen",
    comparedResult: (name: string, rotation: string): string => `${name}: ${symbols.rotation} = ${rotation}`,
    closeCompared: "Verglichene Schale schließen",
    backwards: "Zeit umkehren",
    forwards: "Zeit vorwärts",
    backwardsHelp: "Nur ohne Reibung und mit Stoßzahl 1: Andere Stöße sind nicht umkehrbar",
    dragHelp: "Ziehe eine Scheibe im Laborsystem; die Zeit steht dabei still. " +
        "Tasten: [ und ] wählen eine Scheibe, Pfeile bewegen sie, Escape hebt die Auswahl auf",
    selected: (disc: number) => `Scheibe ${disc} ist ausgewählt. Pfeile bewegen sie, Escape hebt die Auswahl auf.`,
    options: "Von Hand schwenken, vergleichen und mehr",
    speed: "Tempo",
    speedHelp: "Umläufe pro Sekunde",
    view: "Ansicht",
    views: {lab: "Laborsystem", m: "M-System", both: "Beide", density: "Karte: Dichte", flow: "Karte: Strömung",
        spin: "Karte: Eigendrehung"},
    color: "Farbe",
    colors: {sector: "nach Sektor", spin: "nach Eigendrehung", speed: "nach Geschwindigkeit", pinned: "haftend oder frei", id: "nach Scheibe"},
    pinned: "haftend: bewegt sich mit der Wand",
    loose: "frei",
    sparse: "leer",
    dense: "dicht",
    spinAgainst: "gegensinnig",
    spinWith: "im Umlaufsinn",
    atRest: "in Ruhe",
    fast: "schnell",
    flowKey: "Pfeil von einer Zelle: Geschwindigkeit der Schale",
    lapseNote: "Zeitraffer: ein Bild je Umlauf",
    strobeNote: "Stroboskop: ein Bild je Umlauf",
    forces: "Kräfte",
    forcesHelp: "Im M-System: Zentrifugalkraft (von S weg) und Corioliskraft (rechts von der Geschwindigkeit)",
    trails: "Spuren",
    trailsHelp: "Das letzte Drittel eines Umlaufs; mit dem Stroboskop die letzten zwölf Umläufe (T)",
    keep: "Scheiben behalten",
    keepHelp: "Neue Reibungszahlen, Stoßzahlen und Bahnen gelten ab dem nächsten Umlauf für dieselben Scheiben",
    hand: "Von Hand schwenken",
    byHandStop: "Schwenken von Hand beenden",
    byHandHeadline: (turns: string): string =>
        `Bewege die Schale mit dem Zeiger. Der Haufen hat sich um ${turns} Umdrehungen gedreht.`,
    turned: "gedreht",
    turnedHelp: "Winkel, um den sich der Haufen gedreht hat: ϖ, über die Zeit summiert. Der Bogen zeigt diesen Winkel",
    rotationHelp: "Drehrate des Haufens im Verhältnis zur Rate, mit der die Schale ihre Bahn umläuft: Mittel über Scheiben und Zeit. " +
        "Die Unsicherheit erscheint nach 50 Umläufen. Das Band auf der Skala ist das 95-%-Intervall: 1,96 Unsicherheiten nach jeder Seite.",
    periodsHelp: "Umläufe der Schale auf ihrer Bahn",
    differ: (rigid: string): string => `Zählen äußere Scheiben mehr, wie bei einem starren Körper, so hat sich der Haufen um ${rigid} Umdrehungen gedreht: ` +
        "Innere und äußere Scheiben drehen sich verschieden schnell.",
    sides: {with: "im Umlaufsinn", against: "gegensinnig"},
    verdict: (n: number, particles: string): [string, string] =>
        [`${particles} ${n === 1 ? "dreht" : "drehen"} sich `, "."],
    soFar: (particles: string): [string, string] => [`${particles}, bisher: `, "."],
    nearZero: (particles: string): [string, string] => [`${particles} drehen sich kaum; wenn, dann `, "."],
    perPeriod: "Drehrate in jedem Umlauf, und ihr Mittel seit dem Einschwingen",
    symbolOf: {discs: "N", mu_disc: "μ_d", mu_wall: "μ_w", amplitude: "A", restitution: "e"},
    clipped: (n: number, at: number): string => `${n === 1 ? "Ein Umlauf liegt" : `${n} Umläufe liegen`} jenseits von ±${comma(String(at))}: ` +
        "Eine Scheibe kam dem Schwerpunkt sehr nahe.",
    labels: {discs: "Anzahl der Scheiben", mu: "Reibung", amplitude: "Bahnradius", mu_disc: "Reibung zwischen Scheiben",
        mu_wall: "Reibung an der Wand", preset: "Voreinstellung", body: "Körper", radius: "Scheibenradius", mass: "Masse einer Scheibe",
        inertia: "Trägheitsmoment", mixture: "Zweite Sorte", sizes: "Größenverteilung", restitution: "Stoßzahl",
        tangential_restitution: "Tangentiale Stoßzahl", contact_duration: "Kontaktdauer", floor: "Boden",
        floor_friction: "Reibung am Boden", gravity: "Fallbeschleunigung", rolling_resistance: "Rollwiderstand",
        vertical_disc: "Vertikaler Schlupf, Scheiben", vertical_wall: "Vertikaler Schlupf, Wand", container_radius: "Schalenradius",
        period: "Umlaufzeit", speed: "Geschwindigkeit", path: "Bahn", sides: "Ecken der Bahn",
        direction: "Umlaufsinn", path_phase: "Startpunkt auf der Bahn", warmup: "Einschwingzeit", seed: "Startwert",
    },
    spheres: "Rollende Kugeln",
    spheresHelp: "Kugeln, die auf einem Boden rollen, wie im Experiment der Veröffentlichung\n--preset experiment",
    more: "Weitere Parameter",
    turns: (turns: string): string => `${turns} Umdr.`,
    noCommand: "keiner, weil die Simulation verändert wurde, während sie lief",
    maps: {density: "Dichte, bisheriges Mittel", flow: "Strömung relativ zur Schale", spin: "mittlere Eigendrehung"},
    mapEmpty: "noch keine Mittelwerte",
    profile: "Drehrate gegen den Winkel im M-System (Abbildung 3 der Veröffentlichung)",
    theta: "Winkel θ im M-System, M liegt bei 270°",
    discs: "Scheiben",
    wall: "Wand",
    start: "Start",
    stop: "Stopp",
    stopped: "Angehalten.",
    numberOfDiscs: "Anzahl der Scheiben N",
    invalidPeriods: (text: string): string =>
        `Die Länge eines Laufs ist '${text}', aber sie muss eine ganze Zahl von Umläufen von 10 bis 100000 sein.`,
    studyProgress: (done: number, all: number): string => `${done} von ${all} Punkten fertig.`,
    crossing: (discs: string, lower: number, upper: number): string =>
        `${discs} (95 %: ${comma(lower.toFixed(1))} bis ${comma(upper.toFixed(1))})`,
    bracket: (lower: number, upper: number): string => `zwischen ${lower} und ${upper}`,
    collapsed: (runs: string): string => `Weggelassen, weil der Lauf kollabiert ist: ${runs}.`,
    verdicts: {always_rotates: "keine: Der Haufen dreht sich immer im Umlaufsinn",
               always_counterrotates: "keine: Der Haufen dreht sich immer gegensinnig",
               undecided: "nicht bestimmt"} as Record<Exclude<Crossing["verdict"], "crosses">, string>,
    rateNames: {by_time: "zeitlich gemittelt", by_event: "über Ereignisse gemittelt", rigid_by_time: "zeitlich, starrer Körper",
                rigid_by_event: "über Ereignisse, starrer Körper"} as Record<Rate, string>,
    discovery: {
        title: "Drehung und Anzahl der Scheiben",
        about: "Zu dieser Kurve",
        help: "Für jede Anzahl, die du einstellst, rechnet die Seite im Hintergrund vier eigene Läufe: erst 50 Umläufe, dann " +
            "200 und 800. Balken sind 95-%-Intervalle aus der Streuung zwischen den Läufen. Die gestrichelte Linie markiert die jetzige Anzahl, der Ring ihren laufenden " +
            "Mittelwert. Die Punkte bleiben, bis du die Seite schließt; der Link enthält sie.",
        description: (points: number, finding: string): string =>
            `Diagramm der Drehrate gegen die Anzahl der Scheiben mit ${points} Punkten. ${finding}`,
        defaults: "Standardwerte",
        noCrossing: "Verschiebe den Regler für die Anzahl der Scheiben. Wo kehrt sich die Drehrichtung um?",
        bracket: (lower: number, upper: number): string =>
            `Die Richtung kehrt sich zwischen N = ${lower} und N = ${upper} um. Wähle die Zahlen dazwischen.`,
        crossing: (discs: string): string => `Aus deinen Punkten: Die Richtung kehrt sich bei N_c = ${discs} um.`,
        invalid: (points: number): string => `Die Adresse enthält ${points} ${points === 1 ? "beschädigten Punkt" : "beschädigte Punkte"}; ` +
            "die Seite lässt sie weg.\nTipp: Kopiere den ganzen Link.",
        table: "CSV",
        tableHelp: "Die Punkte als Tabelle speichern",
        link: "Link",
        linkHelp: "Einen Link mit den Parametern und den Punkten kopieren",
        linkCopied: "Der Link ist kopiert. Er enthält die Parameter und deine Punkte.",
        linkIs: "Kopiere diesen Link: ",
        clear: "Löschen",
        clearHelp: "Alle Punkte entfernen",
    },
    explorer: {
        title: "Erkunden: Drehrate oder N_c gegen einen beliebigen Parameter",
        help: "Jeder Punkt besteht aus vier Läufen; sie nutzen alle Kerne dieses Rechners. Die übrigen Parameter sind die der Seite. Die Punkte erscheinen mit " +
            "ihren 95-%-Intervallen. Mit der Anzahl der Scheiben auf der Achse ist das Abbildung 5b der Veröffentlichung. N_c ist die " +
            "Anzahl der Scheiben, bei der sich die Richtung umkehrt.",
        quantity: "Zeige",
        crossing: "N_c",
        against: "gegen",
        values: "Werte",
        valuesHelp: "Zahlen und Bereiche VON:SCHRITT:BIS, durch Strichpunkte getrennt",
        curves: "eine Kurve für jeden Wert von",
        curvesHelp: "Wie für die Achse. Bei mu setzt SCHEIBE:WAND die Zahlen zwischen Scheiben und an der Wand getrennt",
        oneCurve: "(eine Kurve)",
        invalid: (most: number): string => "Werte müssen Zahlen oder Bereiche VON:SCHRITT:BIS sein, durch Strichpunkte getrennt; " +
            `mu darf Paare SCHEIBE:WAND haben. Höchstens ${most} Punkte.\nTipp: zum Beispiel discs 5:6:53 und mu 0,1; 1; 1:0.`,
        sameParameter: (name: string): string =>
            `Der Parameter ${name} steht auf der Achse und bei den Kurven.\nTipp: Wähle für die Kurven einen anderen.`,
        searches: (done: number, all: number, runs: number): string =>
            `${done} von ${all} Suchen fertig, bisher ${runs} Läufe.`,
        imprecise: "Die Unsicherheit liegt über dem Ziel von 0,25.",
        description: (points: number, name: string): string => `Diagramm gegen ${name} mit ${points} Punkten.`,
        command: "Dasselbe auf der Kommandozeile:",
        table: "Tabelle speichern (CSV)",
        picture: "Diagramm speichern (PNG)",
    },
    opened: {
        choose: "Datei von swirl öffnen …",
        help: "Ein Ergebnis (JSON) oder ein Zwischenstand (Checkpoint). Du kannst die Datei auch auf die Seite " +
            "ziehen. Sie bleibt auf diesem Rechner.",
        drop: "Ergebnis oder Checkpoint von swirl hier ablegen",
        close: "Datei schließen",
        unknown: (name: string): string => `'${name}' ist kein Ergebnis und kein Checkpoint von swirl.\n` +
            "Tipp: Öffne eine Datei, die swirl run mit --json oder --checkpoint geschrieben hat. Aufzeichnungen lesen die Notebooks.",
        tooLarge: (name: string, most: number): string => `'${name}' ist größer als ${most} MB.\n` +
            "Tipp: Nimm die Kommandozeile.",
        damaged: (name: string): string => `'${name}' ist nicht lesbar: beschädigt oder unvollständig.`,
        wrongValue: (name: string, what: string): string => `'${name}' ist beschädigt: ${what} ist unmöglich.`,
        noParameters: (name: string): string => `'${name}' enthält keine Parameter eines Laufs.`,
        result: (name: string): string => `Ergebnis ${name}`,
        checkpoint: (name: string, events: number): string => `Checkpoint ${name}, nach ${events} Ereignissen`,
        parametersSet: "Die Seite hat jetzt die Parameter der Datei.",
        comparing: "Die Seite wiederholt den Lauf …",
        sameHash: "Die Seite hat den Lauf wiederholt. Der Zustand nach dem letzten Ereignis ist bitgenau derselbe.",
        otherHash: "Die Seite hat den Lauf wiederholt. Der Zustand nach dem letzten Ereignis ist ein anderer.\n" +
            "Tipp: Vielleicht stammt die Datei von einer anderen Version von swirl.",
        tooLong: (events: number, most: number): string =>
            `Der Lauf hat ${events} Ereignisse; die Seite wiederholt Läufe bis ${most}.`,
        quantity: "Größe",
        inFile: "Datei",
        onPage: "Seite",
        events: "Ereignisse",
        hash: "Prüfsumme des Zustands",
    },
    lesson: {
        start: "Schulstunde",
        next: "Weiter",
        back: "Zurück",
        close: "Schulstunde beenden",
        step: (step: number, all: number, title: string): string => `Schritt ${step} von ${all}: ${title}`,
        tryNext: "Das Gegenteil probieren",
        predict: "Wähle zuerst deine Vorhersage.",
        watch: "Beobachte die Schale. Das Ergebnis erscheint, sobald die Seite es gemessen hat.",
        right: "Deine Vorhersage war richtig.",
        wrong: "Deine Vorhersage war anders.",
        result: (text: string): string => `Ergebnis: ${text}`,
        rotation: (rotation: string, direction: string): string => `${symbols.rotation} = ${rotation}, ${direction}`,
        crossing: (discs: string): string => `Die Richtung kehrt sich bei N_c = ${discs} Scheiben um`,
        noCrossing: "Die Richtung kehrt sich in diesem Bereich nicht um",
        directions: ["im Umlaufsinn", "gegensinnig", "gar nicht, oder zu langsam, um es zu sehen"],
        ranges: (lower: number, upper: number): string =>
            lower <= 0 ? `unter ${upper + 1} Scheiben` : upper === Infinity ? `${lower} Scheiben oder mehr` : `${lower} bis ${upper} Scheiben`,
        teaching: "Für Lehrkräfte und Turnierteams",
        worksheetHelp: "Die Schulstunde hat sechs Schritte; in jedem sagt die Klasse vorher, beobachtet und erklärt. Das Arbeitsblatt enthält " +
            "dieselben Fragen, Millimeterpapier für die Messpunkte und ein Experiment mit Murmeln.",
        worksheet: "Arbeitsblatt drucken",
        team: "Für Turnierteams",
    },
    copied: "Kopiert",
    noWebAssembly: "Dieser Browser kann kein WebAssembly mit SIMD, das die Simulation braucht.\n" +
        "Tipp: Nimm Chrome 91, Firefox 113, Safari 16.4 oder neuer.",
    invalidLesson: (text: string, steps: number): string =>
        `Die Adresse enthält lesson=${text}, aber die Schulstunde hat die Schritte 1 bis ${steps}.`,
    invalidEvents: (text: string): string =>
        `Die Adresse enthält events=${text}, aber es muss eine ganze Zahl von 0 bis 10000000 sein.`,
    warmup: (periods: number): string => `Die Mittelwerte beginnen nach ${periods} Umläufen.`,
    notYet: "–",
    grows: "Ohne Reibung wächst die Energie auf dem Vieleck unbegrenzt. Die Mittelwerte gehören zu keinem " +
        "stationären Zustand.",
    noSimulation: "Keine Simulation",
    tooDense: (particles: string, percent: number): string => `${particles} würden ${percent} % der Schale bedecken, und ` +
        "binnen einer Sekunde fand sich keine Anordnung ohne Überlappung.\nTipp: weniger oder kleinere Scheiben oder eine größere " +
        "Schale wählen.",
    paint: "Neu färben",
    paintHelp: "Färbt die Scheiben nach dem Sektor, in dem sie jetzt liegen (P)",
    lapsesByItself: "Automatisch vorspulen",
    lapsesHelp: "Am Anfang und drei Sekunden nach einer Änderung läuft die Zeit schnell, bis es Mittelwerte gibt",
    keys: "Tastatur",
    keysOn: "Einzelne Tasten sind Kurzbefehle",
    close: "Schließen",
    keyNames: {
        " ": ["Leertaste", "abspielen und anhalten"], ".": [".", "nächstes Ereignis"], r: ["R", "neu starten"],
        f: ["F", "bis zu den Mittelwerten vorspulen"], s: ["S", "Stroboskop"], t: ["T", "Spuren"], v: ["V", "nächste Ansicht"],
        c: ["C", "nächste Färbung"], p: ["P", "neu nach Sektor färben"], h: ["H", "von Hand bewegen"], "+": ["+", "eine Scheibe mehr"],
        "-": ["−", "eine Scheibe weniger"], m: ["M", "weitere Parameter"], l: ["L", "Schulstunde"], e: ["E", "Erkunden"],
        d: ["D", "speichern und teilen"], "?": ["?", "diese Liste"],
    } as Record<string, [string, string]>,
    keysOfDish: "In der Schale: [ und ] wählen eine Scheibe, die Pfeile bewegen sie, Escape lässt sie los.",
    placing: (particles: string): string => `${particles} werden verteilt …`,
    running: {
        events: (done: number, all: number): string => `${done} von ${all} Ereignissen fertig.`,
        periods: (done: number, all: number): string => `${done} von ${all} Umläufen fertig.`,
    },
    periods: "Umläufe",
    bodies: {disc: ["Scheibe", "Scheiben"], sphere: ["Kugel", "Kugeln"]},
    counted: (n: number, [one, several]: readonly string[]): string => `${n} ${n === 1 ? one : several}`,
    undecided: (particles: string): string => `${particles}: Die Drehrichtung steht noch nicht fest.`,
    container: (particles: string, view: string): string => `${particles} in einer geschwenkten Schale, ${view}`,
    groups: {friction: "Reibung", particles: "Körper", collisions: "Stöße", floor: "Boden und Rollen",
        container: "Schale und Bahn", run: "Lauf"},
    descriptions: {
        preset: "Voreinstellungen wie im Experiment der Veröffentlichung",
        discs: "Anzahl der Scheiben oder Kugeln",
        mu: "Reibungszahl zwischen den Körpern und an der Wand",
        mu_disc: "Reibungszahl zwischen den Körpern; ohne Angabe die von --mu",
        mu_wall: "Reibungszahl an der Wand; ohne Angabe die von --mu",
        body: "Art der Körper: disc ist eine Scheibe, sphere eine Kugel",
        inertia: "Trägheitsmoment eines Körpers, als Zahl oder Name",
        mass: "Masse eines Körpers",
        radius: "Radius eines Körpers",
        mixture: "Zweite Sorte: Anzahl, Radius und Masse ihrer Körper",
        sizes: "Verteilung der Radien; ersetzt --mixture",
        restitution: "Stoßzahl senkrecht zur Berührfläche; 1 ist elastisch",
        tangential_restitution: "Stoßzahl entlang der Berührfläche, wenn der Kontakt haftet",
        contact_duration: "Kontaktdauer im TC-Modell",
        floor: "Boden unter den Körpern",
        floor_friction: "Reibungszahl des Bodens",
        gravity: "Fallbeschleunigung; wirkt nur mit Boden",
        rolling_resistance: "Rollwiderstandszahl von Kugeln auf dem Boden",
        vertical_disc: "Anteil des vertikalen Schlupfs, dem Reibung entgegenwirkt, zwischen Kugeln",
        vertical_wall: "Anteil des vertikalen Schlupfs, dem Reibung entgegenwirkt, an der Wand",
        container_radius: "Radius der Schale",
        amplitude: "Radius der Bahn des Schalenmittelpunkts",
        period: "Dauer eines Umlaufs auf der Bahn",
        speed: "Geschwindigkeit der Schale; ersetzt --period oder --amplitude",
        path: "Form der Bahn des Schalenmittelpunkts: polygon ist ein Vieleck, circle ein Kreis",
        sides: "Anzahl der Ecken des Vielecks",
        direction: "Umlaufsinn der Bahn",
        path_phase: "Punkt der Bahn, an dem ein Lauf beginnt; 360 für einen Umlauf",
        warmup: "Umläufe am Anfang, die nicht gemittelt werden, oder auto",
        seed: "Startwert des Zufalls, aus dem Anfangsorte und -geschwindigkeiten folgen",
    },
};

export const workerTexts: typeof en.workerTexts = {
    stopped: (error: string): string => `Das Programm ist stehen geblieben: ${error}.\nTipp: Lade die Seite neu.`,
    control: (name: string, code: number): string => `--${name.replaceAll("_", "-")} enthält das Steuer` +
        `zeichen U+${code.toString(16).toUpperCase().padStart(4, "0")}, aber ein Wert muss eine Zeile Text sein.`,
    tooMany: (discs: string, most: number): string => `${discs} Scheiben sind zu viele für die Seite; höchstens ` +
        `${most} gehen.\nTipp: Nimm weniger Scheiben; das Programm swirl hat keine solche Grenze.`,
};

export const lessonSteps: en.StepTexts[] = [
    {title: "Wenige Scheiben",
     text: "Eine runde Schale wird gegen den Uhrzeigersinn auf einem Kreis bewegt und dreht sich dabei selbst nicht. Darin liegen 8 Scheiben. " +
         "Sie sammeln sich auf einer Seite und laufen an der Wand entlang.",
     question: "In welche Richtung dreht sich der Haufen der Scheiben?",
     explanation: "Der Haufen dreht sich im Umlaufsinn, wie die meisten erwarten: Die Schale läuft um, und ihr Inhalt läuft mit."},
    {title: "Viele Scheiben",
     text: "Jetzt liegen 48 Scheiben in derselben Schale. Sonst wurde nichts geändert.",
     question: "In welche Richtung dreht sich der Haufen jetzt?",
     explanation: "Der Haufen dreht sich gegensinnig, obwohl die Schale genau so bewegt wird wie vorher. Im Rest der Schulstunde " +
         "suchen wir den Grund."},
    {title: "Wo sich die Richtung umkehrt",
     text: "Irgendwo zwischen 8 und 48 Scheiben kehrt sich die Richtung um. Diese Zahl heißt N_c. Verschiebe nach deiner Vorhersage " +
         "den Regler für die Anzahl der Scheiben. Jede Anzahl, die du einstellst, gibt einen Punkt im Diagramm.",
     question: "Bei wie vielen Scheiben kehrt sich die Richtung um?",
     explanation: "Nahe N_c schwappt der Haufen durch die Schale, ohne sich zu drehen. Die Seite hat N_c mit " +
         "vielen Läufen gesucht. Passen deine eigenen Punkte dazu?"},
    {title: "Die Schale in Ruhe",
     text: "Diese Ansicht dreht sich mit dem Umlauf mit (M-System). Hier ruht die Schale, und ihr Punkt M, der am weitesten vom " +
         "Mittelpunkt der Bahn entfernt ist, liegt immer unten. Die Scheiben werden zu M hin gedrückt.",
     question: "Wie bewegt sich die Wand in dieser Ansicht?",
     options: ["im Uhrzeigersinn, wie ein Förderband", "gegen den Uhrzeigersinn, wie ein Förderband", "sie ruht"],
     explanation: "Im Raum dreht sich die Wand nicht. Von einem System aus, das sich gegen den Uhrzeigersinn dreht, läuft sie " +
         "im Uhrzeigersinn an den Scheiben vorbei wie ein Förderband. Durch Reibung nimmt dieses Band die Scheiben an der Wand mit: " +
         "gegensinnig."},
    {title: "Auf welche Reibung es ankommt",
     text: "Die 48 Scheiben reiben noch aneinander, aber die Wand ist jetzt vollkommen glatt.",
     question: "In welche Richtung dreht sich der Haufen ohne Reibung an der Wand?",
     explanation: "Ein glattes Band kann nichts mitnehmen, also folgt der Haufen dem Umlauf. Probiere jetzt das Gegenteil: Reibung " +
         "an der Wand, aber keine zwischen den Scheiben. Dann kann die Wand nur die äußersten Scheiben in Drehung versetzen, und sie " +
         "geben nichts weiter. Der Haufen folgt wieder dem Umlauf. Die Gegendrehung braucht beide Arten von Reibung."},
    {title: "Zahnräder oder Haftung?",
     text: "Zahnräder, die sich berühren, drehen sich gegenläufig. Drei Zahnräder in einem Dreieck blockieren sich deshalb; in der " +
         "Physik heißt das Frustration. Verhalten sich die Scheiben wie Zahnräder? Die Farben zeigen die Richtung der Eigendrehung.",
     question: "In welche Richtungen drehen sich zwei Scheiben, die sich berühren?",
     options: ["gegenläufig, wie Zahnräder", "es gibt kaum eine Regel", "in dieselbe Richtung"],
     explanation: "Bei Zahnrädern wäre die Korrelation der Eigendrehungen −1. In der Simulation liegt sie zwischen −0,04 und 0; die " +
         "Scheiben sind also keine Zahnräder. Viel stärker ändert sich der Halt an der Wand: Bei 24 Scheiben laufen die an der Wand mit " +
         "79 % von deren Geschwindigkeit, bei 48 mit 97 %. Bei vielen Scheiben rutscht das Band also kaum. Dann dreht sich der " +
         "Haufen gegensinnig, fast wie ein Pfannkuchen, der an der Wand abrollt."},
];

export const worksheet: typeof en.worksheet = {
    title: "Scheiben in einer geschwenkten Schale",
    name: "Name",
    date: "Datum",
    prediction: "Meine Vorhersage",
    measured: "Gemessen",
    explanation: "Meine Erklärung",
    table: "Schritt 3: Meine Messpunkte",
    graph: "Drehrate gegen die Anzahl der Scheiben",
    crossing: "Die Richtung kehrt sich um bei N_c =",
    experiment: "Eigenes Experiment",
    experimentText: "Lege 5 mm große Kugeln oder gleich große Murmeln in einen Schraubdeckel. Bewege ihn auf dem Tisch im Kreis, etwa zwei " +
        "Umläufe pro Sekunde, ohne ihn zu drehen. Miss, wie weit sich der Haufen in 20 Umläufen des Deckels dreht. " +
        "Markiere dazu eine Kugel farbig.",
    number: "Anzahl",
    turns: "Umdrehungen des Haufens",
    direction: "im Umlaufsinn (+) oder gegensinnig (−)",
    question: "Bei welcher Anzahl von Kugeln hört die Drehung auf? Warum kann sie von der Anzahl auf der Seite abweichen?",
};

export const team: typeof en.team = {
    intro: "„Pancake Rotation“ war Aufgabe 15 des International Young Physicists' Tournament 2023. So kommt ein Team von dieser " +
        "Seite zu eigenen Daten:",
    points: [
        "Mit dem Handy messen: Befestigt es über der Schale, Blickrichtung senkrecht nach unten, und filmt in Zeitlupe (120 oder 240 Bilder " +
            "pro Sekunde). Licht von der Seite, ein matter dunkler Boden und eine farbige Marke an der Schale erleichtern die Auswertung.",
        "Nur eine Größe auf einmal ändern: Anzahl und Größe der Kugeln, Radius und Frequenz der Bahn, Material der Wand. " +
            "„Erkunden“ auf dieser Seite zeigt, welche davon N_c verschiebt.",
        "Aus Videos werden Drehraten: Die Befehle unten finden die Schale und die Kugeln und liefern " +
            "ϖ/Ω mit Unsicherheit.",
        "Unsicherheiten: Aufeinanderfolgende Umläufe sind nicht unabhängig. Teilt das Video deshalb in Blöcke aus mehreren Umläufen und nehmt " +
            "die Streuung der Blockmittel. Wiederholt jede Anzahl mindestens dreimal, jedes Mal mit neuem Anfang. Die Streuung der " +
            "Wiederholungen zeigt Abweichungen, die ein einzelnes Video verbirgt. Eine schiefe Kamera und eine unrunde Bahn ergeben systematische Abweichungen: " +
            "Schwenkt die leere Schale mit einer Marke und prüft, ob deren Bahn rund ist.",
        "Mit dem Modell vergleichen: Stellt auf dieser Seite die Werte eurer Schale ein, oder nehmt --preset experiment (rollende Kugeln). Die " +
            "Reibung kennt ihr am schlechtesten; tragt deshalb N_c gegen sie auf und sucht den Wert, der passt.",
    ],
    commands: ["./swirl track dish.mp4 --out tracks.csv", "./swirl measure tracks.csv",
               "./swirl experiment N24.mp4 N36.mp4 N48.mp4 --out marbles"],
    more: "Ausführlich (englisch):",
    pages: {"explanation/why": "warum sich die Richtung umkehrt", "how-to/record_experiment": "ein Experiment filmen", "tutorials/phone_video": "vom Handyvideo zur Drehrate",
            "explanation/tracking_accuracy": "Genauigkeit der Auswertung", "explanation/statistics": "Unsicherheiten und stationärer Zustand"},
};

export const examples: typeof en.examples = [
    {name: "Wenige", help: "8 Scheiben", given: {discs: "8"}},
    {name: "Viele", help: "48 Scheiben, wie in der Veröffentlichung", given: {}},
    {name: "Glatte Wand", help: "48 Scheiben ohne Reibung an der Wand", given: {mu_disc: "1", mu_wall: "0"}},
    {name: "Glatte Scheiben", help: "48 Scheiben ohne Reibung aneinander", given: {mu_disc: "0", mu_wall: "1"}},
    {name: "Rollende Kugeln", help: "36 Kugeln mit dem Bahnradius der Veröffentlichung, 1,15 cm. Ihr Anhang legt die Hälfte nahe, aber dann verhalten sich Kugeln anders", given: {preset: "experiment", discs: "36"}},
    {name: "Zwei Größen", help: "20 Scheiben und 20 kleinere", given: {discs: "40", mixture: "20:0.6"}},
];
