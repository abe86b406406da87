// Every text of the page, in German.
import type { Texts } from "./en";

export const de: Texts = {
  page: {
    title: "Lockstep", skip: "Zu den Bedienelementen der Maschine",
    theme: "Dunkel oder hell", language: "English", keys: "Tasten", close: "Schließen", cancel: "Abbrechen", dismiss: "Ausblenden", loading: "Verbinde …",
  },
  signIn: {
    token: "Schlüssel", submit: "Anmelden", leave: "Abmelden",
    hint: "Öffne die Adresse, die lockstep-web beim Start ausgegeben hat, oder gib ihren Schlüssel ein.",
  },
  link: {
    lost: "Seit {age} keine Verbindung zum Server. Alle Werte sind die zuletzt bekannten.",
    stale: "Die Steuerung sendet seit {age} nichts. Alle Werte sind die zuletzt bekannten.",
    unreachable: "Es kommen keine Nachrichten einer Steuerung an. Alle Werte sind die zuletzt bekannten.",
    never: "Bisher kamen keine Nachrichten einer Steuerung an. Starte die Maschine: lockstep up",
    configDiffers: "Die Steuerung hat eine andere Konfiguration als dieser Server: Positionen und Grenzen können falsch sein.",
    standby: "Eine Ersatzsteuerung steht bereit", viewers: "{count} Betrachter", writer: "Befehle: {name}",
    writerHere: "Befehle: der Server dieser Seite", viewOnly: "Nur ansehen",
  },
  writer: {
    other: "Seit {time} gibt {name} auf {host} die Befehle für die Maschine. Du kannst sie anhalten und stoppen.",
    take: "Übernehmen",
  },
  mode: {
    Unreachable: "Nicht erreichbar", Waiting: "Wartet auf Achsen", Idle: "Bereit", Homing: "Referenzfahrt", Running: "Läuft",
    Holding: "Hält an", Paused: "Angehalten", Stopping: "Stoppt", Fault: "Fehler", Jogging: "Handfahrt",
  },
  phase: {
    Initialize: "Startet", Standby: "Ruht", Accelerate: "Beschleunigt", Cruise: "Fährt", Decelerate: "Bremst",
    Stop: "Stopp", Fault: "Fehler",
  },
  commands: {
    home: "Referenz", homeAxis: "Referenzfahrt {axis}", run: "Start", hold: "Halt", resume: "Weiter", stop: "Stopp", stops: "Halt und Stopp",
    estop: "Not-Halt", reset: "Quittieren", refused: "Abgelehnt: {title}", noAnswer: "Der Server antwortet nicht.",
    noAnswerRemedy: "Prüfe die Verbindung. Die Achsen einer Handfahrt bremsen von selbst, wenn die Seite sie nicht mehr erneuert.",
    remedy: "Abhilfe: {remedy}", shellRemedy: "Abhilfe, in einer Shell auf dem Rechner der Maschine: {remedy}", place: "{place}: {value}", limit: "erlaubt: {limit}",
    estopHint: "Die Pulse enden sofort. Dies ist keine Sicherheitsfunktion, denn die Motoren bleiben unter Spannung.",
  },
  actions: {
    wait: "warte, bis es geendet hat", home: "Referenz", resume: "Weiter", stop: "Stopp", reset: "Quittieren",
    status: "diese Seite", again: "gib den Befehl noch einmal", take: "übernimm die Maschine",
    timing: "lockstep doctor --timing", incident: "lockstep analyze --incident",
    "run-rest": "lockstep run FILE --from-line LINE",
  },
  alarms: {
    title: "Meldungen", fault: "Fehler", warning: "Warnung", axis: "Achse {axis}", axes: "Achsen {axes}", motor: "Motor {motor}", motors: "Motoren {motors}", board: "Platine {board}", boards: "Platinen {boards}", ended: "Der letzte Auftrag endete vorzeitig",
  },
  axes: {
    title: "Achsen", machine: "Maschine", work: "Werkstück {system}", coordinates: "Koordinaten", homed: "Referenziert",
    notHomed: "Nicht referenziert", missing: "Nicht empfangen", unproved: "Position nicht bestätigt: {cause}", age: "Alter", slack: "Vorlauf", late: "Verzug",
    skew: "Versatz", clock: "Uhr", following: "Schleppfehler: {steps} Schritte", corrected: "Verlorene Schritte nachgeholt: {steps}", now: "< 1 s",
    hints: {
      age: "Alter der Werte dieser Achse", slack: "Kürzeste Zeit von der Ankunft einer Vorgabe bis zu ihrem Beginn, ms",
      late: "Größte Abweichung eines Schritts von seiner befohlenen Zeit, µs", skew: "Größter Versatz zwischen Schritten zweier Achsen, µs",
      clock: "Größter möglicher Fehler der Maschinenzeit dieser Achse, µs",
    },
  },
  boards: { title: "Platinen", has: "Ausgänge und Eingänge" },
  motors: {
    title: "Motoren", moves: "bewegt {axes}", closed: "Geschlossen: {switches}",
    switches: { limit_min: "Endschalter am unteren Ende", limit_max: "Endschalter am oberen Ende", home: "Referenzschalter" },
  },
  jog: {
    title: "Handfahrt", velocity: "Tempo", distance: "Strecke", continuous: "Dauernd", keys: "Pfeiltasten, Bild auf und Bild ab verfahren die Achsen, solange der Fokus hier ist",
    move: "{axis} {sign} fahren", plus: "plus", minus: "minus",
    ended: "Die Maschine hat die Handfahrt beendet. Drücke erneut.", blocked: "Zuerst {axes} referenzieren",
  },
  path: {
    title: "Bahn", twoD: "2D", threeD: "3D", fit: "Einpassen", follow: "Dem Kopf folgen", empty: "Lade ein Programm, um seine Bahn zu sehen.",
    label: "Bahn des Programms. Pfeiltasten verschieben oder drehen sie, Plus und Minus vergrößern, 0 passt sie in die Ansicht ein.", segments: "{count} Strecken", ahead: "Voraus", rapid: "Eilgang",
    done: "Erledigt",
  },
  strip: { title: "Letzte {seconds} s", velocity: "Tempo", position: "Position" },
  job: {
    title: "Auftrag", none: "Noch kein Auftrag", left: "noch", progress: "Fortschritt", waits: "Die Achsen ruhen auf der Bahn, bis mehr vom Programm ankommt",
    line: "Zeile {line}", outcome: { Done: "Fertig", Stopped: "Gestoppt", Failed: "Fehlgeschlagen" },
    kind: { home: "Referenzfahrt", move: "Fahrt", run: "Programm", "own-move": "Fahrt einer Achse", jog: "Handfahrt", return: "Rückweg zur Pause" },
    number: "Auftrag {number}", held: "Angehalten in Zeile {line}", braking: "Bremst …",
  },
  inputs: {
    title: "Eingänge", open: "{name}: offen",
    closed: { "emergency-stop": "{name}: Not-Halt gedrückt", door: "{name}: Tür offen", program: "{name}: geschlossen", probe: "{name}: berührt", home: "{name}: Referenzschalter geschlossen" },
  },
  outputs: {
    title: "Ausgänge", on: "ein", off: "aus", same: "{name}: {level}", differs: "{name}: {level} (Programm: {asked})",
    unknown: "{name}: nicht bekannt (Programm: {asked})", analogAsked: "{name}: {asked} % (Programm)", analog: "{name}: {percent} %",
    analogDiffers: "{name}: {percent} % (Programm: {asked} %)", pulses: "{name}: noch {left} von {of} Pulsen", noPulses: "{name}: keine Pulse mehr",
  },
  devices: {
    title: "Vom Programm befohlen", forward: "Spindel rechts {rpm} 1/min", reverse: "Spindel links {rpm} 1/min", mist: "Nebel", flood: "Kühlmittel",
    tool: "Werkzeug {number}", output: "Ausgang {number}", notConnected: "nichts ist angeschlossen",
  },
  pause: {
    reason: {
      "program-stop": "Programmhalt", "optional-stop": "Wahlweiser Halt", "tool-change": "Werkzeug wechseln", "pallet-change": "Palette wechseln", hold: "Angehalten",
      input: "Wartet auf einen Eingang", "input-timeout": "Der Eingang blieb aus, Weiter wartet erneut",
    },
    waitLeft: "{text} (noch {seconds} s)",
    tool: "Wechsle zu Werkzeug {tool}", noTool: "Nimm das Werkzeug heraus", move: "{axis} nach {to}", title: "Zurückfahren und weiter",
    hint: "Der Auftrag wartet. Achsen dürfen von Hand gefahren und genullt werden; dann Weiter.",
    away: "Achsen wurden bewegt. Weiter zeigt erst den Weg zurück zum Ort der Pause, dann fährt die Maschine dorthin.",
    returning: "Die Maschine fährt zum Ort der Pause zurück.", confirm: "Zurückfahren und weiter",
    explain: "Achsen wurden in der Pause bewegt. Die Maschine fährt im Eilgang auf diesem Weg zurück, in Maschinenkoordinaten, dann geht der Auftrag weiter:",
  },
  overrides: { title: "Anpassung", feed: "Vorschub", rapid: "Eilgang", normal: "100 %", unit: "%" },
  program: {
    title: "Programm", load: "Programm laden", drop: "Lege eine G-Code-Datei hier ab, oder wähle eine mit „Programm laden“.", checking: "Prüfe …", none: "Kein Programm ist geladen.",
    figures: "{lines} Zeilen, {size}", failed: "{name} wurde nicht geladen", errorAt: "Zeile {line}, Spalte {column}: {message}", error: "{message}",
    tooLong: "Die Datei hat {size}; erlaubt sind höchstens {limit}", notes: "{count} Hinweise", noteAt: "Zeile {line}: {text}", follow: "Der Zeile in Ausführung folgen", text: "G-Code",

  },
  mdi: {
    title: "MDI", label: "Eine Zeile G-Code", send: "Senden", placeholder: "G0 X10 Y10", history: "Frühere Zeilen", accepted: "angenommen", refused: "abgelehnt",
    keys: "Pfeil auf und ab: frühere Zeilen", modes: "Modi der nächsten Zeile:",
  },
  probe: {
    title: "Taster", what: "Messen", start: "Start", axis: "Achse", number: "Taster",
    none: "Diese Maschine hat keinen Taster: In ihrer Datei fehlt ein Eingang mit use: PROBE.",
    kind: { touch: "Antasten", edge: "Kante", angle: "Winkel einer Kante", corner: "Außenecke", bore: "Bohrung", boss: "Zapfen", tool: "Werkzeuglänge", surface: "Fläche" },
    hint: {
      touch: "Eine Achse fährt, bis der Taster schaltet, höchstens den Weg von hier.",
      edge: "Die Spitze steht neben der Kante, auf der Höhe, auf der sie antasten soll.",
      angle: "Die Spitze steht neben der Kante, auf der Höhe, auf der sie antasten soll.",
      corner: "Die Spitze steht vor beiden Flächen, auf der Höhe, auf der sie antasten soll. Der Weg führt etwa zur Ecke.",
      bore: "Die Spitze steht in der Bohrung, höchstens ein Fünftel des Durchmessers neben der Mitte.",
      boss: "Die Spitze steht frei über dem Zapfen, höchstens ein Fünftel des Durchmessers neben der Mitte.",
      tool: "Das Werkzeug steht über dem Messtaster.",
      surface: "Die Spitze steht über der Fläche, der Weg zum ersten Punkt ist frei. Orte sind Maschinenkoordinaten.",
    },
    field: {
      feed: "Vorschub, mm/min", back: "Abheben dazwischen, mm", tip: "Durchmesser der Spitze, mm", along: "Entlang der Kante, mm", beside: "Neben der Ecke, mm",
      diameter: "Durchmesser etwa, mm", down: "Höchstens abwärts, mm", clearance: "Abstand, mm", setter: "Z des Messtasters, mm", spacing: "Höchster Abstand, mm",
      way: "Höchster Weg, mm", way_x: "Weg in X, mm", way_y: "Weg in Y, mm", from_x: "X von, mm", to_x: "X bis, mm", from_y: "Y von, mm", to_y: "Y bis, mm",
    },
    flag: { away: "Schaltet jetzt, wegfahren", may_miss: "Darf ohne Antastung enden" },
    running: "{kind}: bisher {touches} Antastungen", runningSurface: "Fläche: Punkt {point} von {points}",
    result: { diameterX: "Durchmesser längs X", diameterY: "Durchmesser längs Y", angle: "Winkel", length: "Länge", lowest: "Tiefstes Z", highest: "Höchstes Z", input: "Eingang", noTouch: "keine Antastung" },
    reads: "zeigt", set: "Nullpunkt oder Drehung setzen", setTool: "Werkzeuglänge setzen", kept: "{name} ist gesetzt.", keptTool: "Die Länge von Werkzeug {number} ist gesetzt.",
    heights: "{range} mm vom Tiefsten zum Höchsten; eine Linie je {step} mm. X {from_x} bis {to_x}, Y {from_y} bis {to_y}.",
    heightAt: "X {x}  Y {y}: Z {z} mm", saveHeights: "heights.csv speichern",
  },
  offsets: {
    title: "Nullpunkte", system: "System", active: "aktiv", touch: "{axis} hier auf 0", edit: "{system}, {axis}", rotation: "Drehung",
    g92: "G92", none: "Noch nicht empfangen",
    pause: "Der Rest des wartenden Auftrags behält die Orte, mit denen er geladen wurde. Mit neuen Nullpunkten: stoppen, neu laden und ab seiner Zeile starten.",
  },
  tools: {
    title: "Werkzeuge", number: "Nr.", pocket: "Platz", length: "Länge Z", diameter: "Durchmesser", add: "Speichern", remove: "Werkzeug {number} entfernen",
    none: "Die Werkzeugtabelle ist leer.",
  },
  reports: {
    title: "Berichte", none: "Noch keine Berichte auf diesem Rechner. lockstep analyze erstellt einen.", report: "Bericht", incident: "Vorfall", refresh: "Neu lesen",
  },
  keys: {
    title: "Tasten", estop: "F1", estopText: "Not-Halt", stop: "Escape", stopText: "Stopp", hold: "F2", holdText: "Halt", resume: "F4",
    resumeText: "Weiter", jog: "Pfeile, Bild auf, Bild ab", jogText: "Handfahrt, solange der Fokus auf den Fahrtasten liegt und die Taste gehalten wird",
    view: "Pfeile, +, −, 0", viewText: "Bahn verschieben, vergrößern und einpassen, solange der Fokus auf ihr liegt",
  },
};
