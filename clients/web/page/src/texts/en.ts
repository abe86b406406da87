// Every text of the page, in English. Words in braces are filled in; another language is a file like this one.

export const en = {
  page: {
    title: "Lockstep", skip: "Skip to the machine's controls",
    theme: "Dark or light", language: "Deutsch", keys: "Keys", close: "Close", cancel: "Cancel", dismiss: "Dismiss", loading: "Connecting …",
  },
  signIn: {
    token: "Token", submit: "Sign in", leave: "Sign out",
    hint: "Open the address that lockstep-web printed at its start, or enter its token.",
  },
  link: {
    lost: "No connection to the server for {age}. All values are the last known.",
    stale: "The coordinator has been silent for {age}. All values are the last known.",
    unreachable: "No messages are received from a coordinator. All values are the last known.",
    never: "No messages have been received from a coordinator yet. Start the machine: lockstep up",
    configDiffers: "The coordinator runs another configuration than this server reads: positions and limits may be wrong.",
    standby: "A standby coordinator is ready", viewers: "{count} viewing", writer: "Commands: {name}",
    writerHere: "Commands: this page's server", viewOnly: "View only",
  },
  writer: {
    other: "{name} on {host} has been the machine's writer since {time}. You can hold and stop the machine.",
    take: "Take over",
  },
  mode: {
    Unreachable: "Unreachable", Waiting: "Waiting for axes", Idle: "Idle", Homing: "Homing", Running: "Running",
    Holding: "Holding", Paused: "Held", Stopping: "Stopping", Fault: "Fault", Jogging: "Jogging",
  },
  phase: {
    Initialize: "Initialize", Standby: "Standby", Accelerate: "Accelerate", Cruise: "Cruise", Decelerate: "Decelerate",
    Stop: "Stop", Fault: "Fault",
  },
  commands: {
    home: "Home", homeAxis: "Home {axis}", run: "Run", hold: "Hold", resume: "Resume", stop: "Stop", stops: "Hold and stop",
    estop: "Emergency stop", reset: "Reset", refused: "Refused: {title}", noAnswer: "The server does not answer.",
    noAnswerRemedy: "Check the connection. The axes of a jog brake by themselves when the page no longer renews it.",
    remedy: "Remedy: {remedy}", shellRemedy: "Remedy, in a shell on the machine's host: {remedy}", place: "{place}: {value}", limit: "allowed: {limit}",
    estopHint: "Pulses stop at once. This is not a safety function, because the motors keep their power.",
  },
  /** The remedies of faults and refusals. */
  actions: {
    wait: "wait until it has ended", home: "Home", resume: "Resume", stop: "Stop", reset: "Reset", status: "this page",
    again: "give the command again", take: "take over the machine", timing: "lockstep doctor --timing",
    incident: "lockstep analyze --incident", "run-rest": "lockstep run FILE --from-line LINE",
  },
  alarms: {
    title: "Alarms", fault: "Fault", warning: "Warning", axis: "Axis {axis}", axes: "Axes {axes}", motor: "Motor {motor}", motors: "Motors {motors}", board: "Board {board}", boards: "Boards {boards}", ended: "The last job ended early",
  },
  axes: {
    title: "Axes", machine: "Machine", work: "Work {system}", coordinates: "Coordinates", homed: "Homed",
    notHomed: "Not homed", missing: "Not received", unproved: "Position not confirmed: {cause}", age: "Age", slack: "Slack", late: "Late",
    skew: "Skew", clock: "Clock", following: "Following error: {steps} steps", corrected: "Lost steps made up: {steps}", now: "< 1 s",
    hints: {
      age: "Age of this axis's values", slack: "Least time from a setpoint's arrival to its start, ms",
      late: "Largest deviation of a step from its commanded time, µs", skew: "Largest skew between steps of two axes, µs",
      clock: "Largest possible error of the axis's machine time, µs",
    },
  },
  boards: { title: "Boards", has: "outputs and inputs" },
  motors: {
    title: "Motors", moves: "moves {axes}", closed: "Closed: {switches}",
    switches: { limit_min: "limit switch at the lower end", limit_max: "limit switch at the upper end", home: "home switch" },
  },
  jog: {
    title: "Jog", velocity: "Speed", distance: "Distance", continuous: "Continuous", keys: "Arrow keys, Page Up and Page Down jog while the focus is here",
    move: "Jog {axis} {sign}", plus: "plus", minus: "minus",
    ended: "The machine ended the jog. Press again.", blocked: "Home {axes} first",
  },
  path: {
    title: "Path", twoD: "2D", threeD: "3D", fit: "Fit", follow: "Follow the head", empty: "Load a program to see its path.",
    label: "Path of the program. Arrow keys move or rotate it, plus and minus zoom, 0 fits it into the view.", segments: "{count} segments", ahead: "Ahead", rapid: "Rapid",
    done: "Done",
  },
  strip: { title: "Last {seconds} s", velocity: "Velocity", position: "Position" },
  job: {
    title: "Job", none: "No job yet", left: "left", progress: "Progress", waits: "The axes rest on the path until more of the program arrives",
    line: "Line {line}", outcome: { Done: "Done", Stopped: "Stopped", Failed: "Failed" },
    kind: { home: "Homing", move: "Move", run: "Program", "own-move": "Single-axis move", jog: "Jog", return: "Return to the pause" },
    number: "Job {number}", held: "Held at line {line}", braking: "Braking …",
  },
  inputs: {
    title: "Inputs", open: "{name}: open",
    closed: { "emergency-stop": "{name}: emergency stop pressed", door: "{name}: door open", program: "{name}: closed", probe: "{name}: touches", home: "{name}: home switch closed" },
  },
  outputs: {
    title: "Outputs", on: "on", off: "off", same: "{name}: {level}", differs: "{name}: {level} (program: {asked})",
    unknown: "{name}: not known (program: {asked})", analogAsked: "{name}: {asked} % (program)", analog: "{name}: {percent} %",
    analogDiffers: "{name}: {percent} % (program: {asked} %)", pulses: "{name}: {left} of {of} pulses left", noPulses: "{name}: no pulses left",
  },
  devices: {
    title: "Commanded by the program", forward: "Spindle forward {rpm} rpm", reverse: "Spindle reverse {rpm} rpm", mist: "Mist", flood: "Flood",
    tool: "Tool {number}", output: "Output {number}", notConnected: "nothing is connected",
  },
  pause: {
    reason: {
      "program-stop": "Program stop", "optional-stop": "Optional stop", "tool-change": "Change the tool", "pallet-change": "Change the pallet", hold: "Held",
      input: "Waits for an input", "input-timeout": "The wait for an input timed out, Resume waits again",
    },
    waitLeft: "{text} ({seconds} s left)",
    tool: "Change to tool {tool}", noTool: "Take out the tool", move: "{axis} to {to}", title: "Return and resume",
    hint: "The job waits. Axes may be jogged and touched off; then resume.",
    away: "Axes were moved. Resume first shows the way back to the place of the pause, then the machine returns there.",
    returning: "The machine returns to the place of the pause.", confirm: "Return and resume",
    explain: "Axes were moved in the pause. The machine returns by these rapid moves, in machine coordinates, then the job continues:",
  },
  overrides: { title: "Overrides", feed: "Feed", rapid: "Rapid", normal: "100 %", unit: "%" },
  program: {
    title: "Program", load: "Load program", drop: "Drop a G-code file here, or choose one with Load program.", checking: "Checking …", none: "No program is loaded.",
    figures: "{lines} lines, {size}", failed: "{name} was not loaded", errorAt: "Line {line}, column {column}: {message}", error: "{message}",
    tooLong: "The file has {size}; it can have at most {limit}", notes: "{count} notes", noteAt: "Line {line}: {text}", follow: "Follow the line in motion", text: "G-code",

  },
  mdi: {
    title: "MDI", label: "One line of G-code", send: "Send", placeholder: "G0 X10 Y10", history: "Earlier lines", accepted: "accepted", refused: "refused",
    keys: "Arrow up and down: earlier lines", modes: "Modes of the next line:",
  },
  probe: {
    title: "Probe", what: "Measure", start: "Start", axis: "Axis", number: "Probe",
    none: "This machine has no probe: its file has no input with use: PROBE.",
    kind: { touch: "Touch", edge: "Edge", angle: "Angle of an edge", corner: "Outer corner", bore: "Bore", boss: "Boss", tool: "Tool length", surface: "Surface" },
    hint: {
      touch: "One axis moves until the probe touches, at most the way from here.",
      edge: "The tip stands beside the edge, at the height at which it is to touch.",
      angle: "The tip stands beside the edge, at the height at which it is to touch.",
      corner: "The tip stands off both faces, at the height at which it is to touch. The way is about to the corner.",
      bore: "The tip stands in the bore, within a fifth of its diameter of the centre.",
      boss: "The tip stands above the boss, clear of it, within a fifth of its diameter of the centre.",
      tool: "The tool stands above the setter.",
      surface: "The tip stands above the surface, clear of everything on the way to the first point. Places are machine coordinates.",
    },
    field: {
      feed: "Feed, mm/min", back: "Off between touches, mm", tip: "Tip diameter, mm", along: "Along the edge, mm", beside: "Beside the corner, mm",
      diameter: "Diameter about, mm", down: "Down at most, mm", clearance: "Clearance, mm", setter: "Z of the setter, mm", spacing: "Spacing at most, mm",
      way: "Way at most, mm", way_x: "Way in X, mm", way_y: "Way in Y, mm", from_x: "X from, mm", to_x: "X to, mm", from_y: "Y from, mm", to_y: "Y to, mm",
    },
    flag: { away: "Touches now, move off", may_miss: "May end without a touch" },
    running: "{kind}: {touches} touches so far", runningSurface: "Surface: point {point} of {points}",
    result: { diameterX: "Diameter along X", diameterY: "Diameter along Y", angle: "Angle", length: "Length", lowest: "Lowest Z", highest: "Highest Z", input: "Input", noTouch: "no touch" },
    reads: "reads", set: "Set zero or rotation", setTool: "Set tool length", kept: "{name} is set.", keptTool: "The length of tool {number} is set.",
    heights: "{range} mm from the lowest to the highest; a line each {step} mm. X {from_x} to {to_x}, Y {from_y} to {to_y}.",
    heightAt: "X {x}  Y {y}: Z {z} mm", saveHeights: "Save heights.csv",
  },
  offsets: {
    title: "Offsets", system: "System", active: "active", touch: "Set {axis} to 0 here", edit: "{system}, {axis}", rotation: "Rotation",
    g92: "G92", none: "Not received yet",
    pause: "The rest of the paused job keeps the places with which it was loaded. To run it with new offsets: stop, load it again, and run it from its line.",
  },
  tools: {
    title: "Tools", number: "No.", pocket: "Pocket", length: "Length Z", diameter: "Diameter", add: "Save tool", remove: "Remove tool {number}",
    none: "The tool table is empty.",
  },
  reports: {
    title: "Reports", none: "No reports on this host yet. lockstep analyze makes one.", report: "Report", incident: "Incident", refresh: "Refresh",
  },
  keys: {
    title: "Keys", estop: "F1", estopText: "Emergency stop", stop: "Escape", stopText: "Stop", hold: "F2", holdText: "Hold", resume: "F4",
    resumeText: "Resume", jog: "Arrows, Page Up, Page Down", jogText: "Jog, while the focus is on the jog pad and the key is held",
    view: "Arrows, +, −, 0", viewText: "Move, zoom and fit the path, while the focus is on it",
  },
};

export type Texts = typeof en;
