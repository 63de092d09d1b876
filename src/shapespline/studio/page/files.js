// In and out: open, drop, paste, examples; export, copy, pictures of the view, sessions.

import { asked } from "./store.js";
import { byId, choice, element, fill, input } from "./words.js";

const SESSION = ".studio.json";
/** @type {[string, string][]} */
const COPIES = [["svg", "SVG"], ["python", "Python"], ["command", "Command line"], ["toml", "Settings"],
  ["view", "Picture of the view"], ["session", "This session as a file"]];
/** @type {Object<string, string>} */
const NAMES = { ".svg": "SVG", ".dxf": "DXF", ".pdf": "PDF", ".json": "JSON, with the fit", ".step": "STEP", ".igs": "IGES",
  ".3dm": "3dm of Rhino", ".csv": "CSV, points on the curve", ".geojson": "GeoJSON", ".png": "PNG", ".py": "Python", ".nc": "G-code",
  ".glif": "GLIF, a glyph of a font" };

export class Files {
  /** @param {import("./main.js").App} app */
  constructor(app) {
    this.app = app;
    /** @type {{name: string, bytes: Uint8Array} | null} what is open */
    this.file = null;
    /** @type {{generation: number, file: {name: string, bytes: Uint8Array} | null} | null} what is being read; an example has no file yet */
    this.reading = null;
    /** The example that is open, or nothing. */
    this.exampleOpen = "";
    this.pixels = 0;
    this.rows = 0;
    this.most = 64e6;
    this.generation = 0;
    /** @type {any} what a session asks for once its file is there */
    this.after = null;
    this.purpose = "";
    element("open").addEventListener("click", () => input("file").click());
    input("file").addEventListener("change", () => {
      const file = input("file").files?.[0];
      input("file").value = "";
      if (file) this.take(file);
    });
    element("paste").addEventListener("click", () => this.pasteFromClipboard());
    document.addEventListener("paste", (event) => {
      if (event.target instanceof HTMLInputElement || event.target instanceof HTMLTextAreaElement) return;
      const file = event.clipboardData?.files[0];
      if (file) this.take(file);
      else this.takeText(event.clipboardData?.getData("text") ?? "");
    });
    addEventListener("dragover", (event) => {
      event.preventDefault();
      document.body.classList.add("dropping");
    });
    addEventListener("dragleave", (event) => {
      if (!event.relatedTarget) document.body.classList.remove("dropping");
    });
    addEventListener("drop", (event) => {
      event.preventDefault();
      document.body.classList.remove("dropping");
      const file = event.dataTransfer?.files[0];
      if (file) this.take(file);
      else this.takeText(event.dataTransfer?.getData("text") ?? "");
    });
    choice("examples").addEventListener("change", () => this.example(choice("examples").value));
    element("export").addEventListener("click", () => this.openExport());
    choice("format").addEventListener("change", () => this.formatChanged());
    element("export-go").addEventListener("click", () => this.export());
    element("copy").addEventListener("click", () => this.openCopy());
    element("copies").replaceChildren(...COPIES.map(([kind, text]) => {
      const one = document.createElement("button");
      Object.assign(one, { type: "button", id: `copy-${kind}`, textContent: text });
      one.addEventListener("click", () => this.copy(kind));
      return one;
    }));
    element("save-text").addEventListener("click", () => this.saveText());
    this.saved = { name: "", text: "" };
  }

  /** @param {any} hello */
  offer(hello) {
    this.most = hello.most_bytes;
    fill(choice("examples"), hello.examples.map((/** @type {any} */ one) => [one.id, one.title]));
    const own = document.createElement("option");
    Object.assign(own, { value: "", textContent: "own file", hidden: true });
    choice("examples").append(own);
    fill(choice("format"), hello.formats.filter((/** @type {string} */ one) => NAMES[one]).map((/** @type {string} */ one) => [one, NAMES[one]]));
    choice("format").value = ".svg";
  }

  /** @param {string} id */
  example(id) {
    this.send({ type: "example", id }, null);
    choice("examples").value = id;
  }

  /** @param {File} file */
  async take(file) {
    if (file.size > this.most) {
      this.app.trouble(`${file.name}: files must have at most ${this.most / 1e6} MB, got ${Math.round(file.size / 1e6)}; use the command line for larger ones`);
      return;
    }
    const bytes = new Uint8Array(await file.arrayBuffer());
    if (file.name.endsWith(SESSION)) this.openSession(new TextDecoder().decode(bytes));
    else this.open(file.name || "pasted.png", bytes);
  }

  /** Text as a file: SVG, or a table of points. @param {string} text */
  takeText(text) {
    if (!text.trim()) return;
    const name = text.includes("<svg") ? "pasted.svg" : text.trimStart().startsWith("{") ? "pasted.json" : "pasted.csv";
    this.open(name, new TextEncoder().encode(text));
  }

  async pasteFromClipboard() {
    try {
      for (const item of await navigator.clipboard.read()) {
        const kind = item.types.find((type) => type.startsWith("image/"));
        if (kind) {
          const blob = await item.getType(kind);
          this.take(new File([blob], `pasted.${kind === "image/svg+xml" ? "svg" : kind.slice(6)}`));
          return;
        }
      }
      this.takeText(await navigator.clipboard.readText());
    } catch {
      this.app.trouble("the browser does not let the page read the clipboard: press Ctrl V instead");
    }
  }

  /** @param {string} name @param {Uint8Array} bytes @param {Object<string, any>} [options] */
  open(name, bytes, options = {}) {
    this.send({ type: "open", name, options }, { name, bytes });
    choice("examples").value = "";
  }

  /** Open again what the page holds: the program was gone and is back. */
  again() {
    const file = this.reading?.file ?? this.file;
    const options = file === this.file ? this.app.store.now.reading : {};
    if (file) this.send({ type: "open", name: file.name, options }, file);
  }

  /** Read the picture that is open in another way. @param {Object<string, any>} options */
  reread(options) {
    this.send({ type: "reread", options }, this.file, false);
  }

  /** @param {Object<string, any>} header @param {{name: string, bytes: Uint8Array} | null} file @param {boolean} [withBytes] */
  send(header, file, withBytes = true) {
    this.generation += 1;
    this.reading = { generation: this.generation, file };
    this.app.wire.send({ ...header, generation: this.generation }, withBytes ? file?.bytes : undefined);
    this.app.say();
  }

  /** A document is there. @param {{name: string, generation: number, file?: Uint8Array}} message */
  arrived({ name, generation, file }) {
    const { reading, file: before } = this;
    if (file) this.file = { name, bytes: file.slice() };
    else if (reading?.generation === generation && reading.file) this.file = reading.file;
    if (reading?.generation === generation) {
      this.reading = null;
      if (reading.file !== before) this.exampleOpen = choice("examples").value;
    }
  }

  /** What was being read is not wanted, or cannot be: what is open stays. */
  stays() {
    const { app } = this;
    this.reading = this.after = null;
    choice("examples").value = this.exampleOpen;
    if (!app.scene.shape) return;
    app.lastReading = JSON.stringify(app.scene.shape.options);
    const before = app.store.past.at(-1);
    if (before && JSON.stringify(app.store.now.reading) !== app.lastReading) app.store.undo();
  }

  /** The picture behind the outlines, decoded by the browser. */
  async decode() {
    const { scene } = this.app;
    scene.image?.close();
    scene.image = null;
    if (!this.file || !scene.shape?.picture) return;
    try {
      scene.image = await createImageBitmap(new Blob([this.file.bytes.slice()]));
      [this.pixels, this.rows] = [scene.image.width, scene.image.height];
    } catch {
      // A browser knows no TIFF: the outlines are there all the same.
    }
    scene.draw();
  }

  openExport() {
    byId("export-dialog", HTMLDialogElement).showModal();
    this.formatChanged();
  }

  formatChanged() {
    element("arcs-label").hidden = choice("format").value !== ".dxf";
  }

  export() {
    const format = choice("format").value;
    /** @type {Object<string, any>} */
    const options = {};
    if (choice("out-unit").value) options.unit = choice("out-unit").value;
    if (+input("out-scale").value > 0) options.scale = +input("out-scale").value;
    if (format === ".dxf" && input("out-arcs").checked) options.arcs = true;
    this.purpose = "file";
    this.app.whenDone(() => this.app.wire.send({ type: "export", format, options, generation: 1 }));
  }

  openCopy() {
    byId("copied", HTMLTextAreaElement).value = "";
    element("copy-said").textContent = "";
    element("save-text").toggleAttribute("disabled", true);
    byId("copy-dialog", HTMLDialogElement).showModal();
  }

  /** @param {string} kind */
  copy(kind) {
    const { app } = this;
    if (kind === "view") {
      app.scene.canvas.toBlob((blob) => blob && download("view.png", blob));
    } else if (kind === "session") {
      this.saveSession();
    } else if (kind === "svg") {
      this.purpose = "copy";
      app.whenDone(() => app.wire.send({ type: "export", format: ".svg", options: {}, generation: 1 }));
    } else {
      app.wire.send({ type: "copy", kind, ...asked(app.store.now) });
    }
  }

  /** @param {any} message */
  hearFile(message) {
    if (this.purpose === "copy") this.hearText({ kind: "svg", name: message.name, text: new TextDecoder().decode(message.bytes) });
    else download(message.name, new Blob([message.bytes]));
  }

  /** @param {{kind: string, name: string, text: string}} message */
  async hearText({ kind, name, text }) {
    const area = byId("copied", HTMLTextAreaElement);
    area.value = text;
    const stem = name.replace(/\.[^.]*$/, "");
    this.saved = { name: { python: `${stem}.py`, toml: "settings.toml", svg: `${stem}.svg` }[kind] ?? `${stem}.sh`, text };
    element("save-text").toggleAttribute("disabled", false);
    try {
      await navigator.clipboard.writeText(text);
      element("copy-said").textContent = "Copied to the clipboard.";
    } catch {
      area.select();
      element("copy-said").textContent = "Selected: press Ctrl C.";
    }
  }

  saveText() {
    download(this.saved.name, new Blob([this.saved.text]));
  }

  saveSession() {
    const { file, app } = this;
    if (!file) return;
    let binary = "";
    for (let i = 0; i < file.bytes.length; i += 32768) binary += String.fromCharCode(...file.bytes.subarray(i, i + 32768));
    const said = { shapespline_studio: 1, name: file.name, state: app.store.now, content: btoa(binary) };
    download(`${file.name.replace(/\.[^.]*$/, "")}${SESSION}`, new Blob([JSON.stringify(said)]));
  }

  /** @param {string} text */
  openSession(text) {
    try {
      const said = JSON.parse(text);
      if (said.shapespline_studio !== 1) throw new Error("another version");
      const bytes = Uint8Array.from(atob(said.content), (one) => one.charCodeAt(0));
      this.after = said.state;
      this.open(said.name, bytes, said.state.reading);
    } catch {
      this.app.trouble("this is no session of the studio; save one with Copy, This session as a file");
    }
  }
}

/** @param {string} name @param {Blob} blob */
function download(name, blob) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
