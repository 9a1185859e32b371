// The player's folder: kept in the browser's database, written after every turn that changed it, by one page at a time.

export const HOME = "/ninja-game-player";
const SLOW = 1000; // ms for which a slow disk may hold the game up
const RETRY = 3000; // ms after a failed write; less than a notice of it is shown

export class PlayerFolder {
  seen; // the state that was read or written last
  exports; // names of the files that were there or are downloaded

  constructor(fs) {
    this.fs = fs;
    this.lasting = true;
    this.writing = this.saving = null;
    this.retryAt = 0;
  }

  // Mount the folder and read it. Where there is no database (a private window), it lasts as long as the page.
  async open() {
    this.fs.mkdirTree(HOME);
    try {
      this.fs.mount(this.fs.filesystems.IDBFS, {}, HOME);
      await this.sync(true);
    } catch (error) {
      console.warn("The player's folder cannot be kept:", error);
      this.lasting = false;
    }
    for (const name of ["levels", "replays", "exports"]) this.fs.mkdirTree(`${HOME}/${name}`);
    this.seen = this.state();
    this.exports = new Set(this.names("exports"));
  }

  // Read the folder, or write it; only what is written counts as `seen`.
  async sync(reading) {
    const state = this.state();
    await new Promise((done, failed) => this.fs.syncfs(reading, (error) => (error ? failed(error) : done())));
    this.seen = state;
  }

  names(folder) {
    return this.fs.readdir(`${HOME}/${folder}`).filter((name) => !name.startsWith("."));
  }

  // A text that changes with every change of a file.
  state() {
    let count = 0;
    let newest = 0;
    let bytes = 0;
    const walk = (node) => {
      count += 1;
      newest = Math.max(newest, +node.mtime);
      if (this.fs.isDir(node.mode)) for (const name in node.contents) walk(node.contents[name]);
      else bytes += node.usedBytes;
    };
    walk(this.fs.lookupPath(HOME).node);
    return `${count} ${newest} ${bytes}`;
  }

  get unsaved() {
    return this.lasting && this.state() !== this.seen;
  }

  // Save what changed. `writing` lasts until all is on the disk or a write fails, `saving` while the game waits for it.
  // After a failure it is tried again once RETRY has passed, or at once if `now`.
  saveChanges(tell, { now = false } = {}) {
    if (this.writing || !this.unsaved || (!now && performance.now() < this.retryAt)) return;
    this.writing = this.save(tell).finally(() => (this.writing = null));
    const slow = new Promise((done) => setTimeout(done, SLOW));
    this.saving = Promise.race([this.writing, slow]).finally(() => (this.saving = null));
  }

  // What changes meanwhile, such as the last things when the page is left, is saved too.
  async save(tell) {
    try {
      while (this.unsaved) await this.sync(false);
      if (this.retryAt) tell("Saved in this browser");
      this.retryAt = 0;
    } catch (error) {
      this.retryAt = performance.now() + RETRY;
      tell(`Not saved in this browser: ${error.message ?? error}. It is tried again.`);
    }
  }

  // What the game has written for the player since the last call: offered as downloads.
  newExports() {
    const names = this.names("exports").filter((name) => !this.exports.has(name));
    for (const name of names) this.exports.add(name);
    return names;
  }

  download(name) {
    download(name, this.fs.readFile(`${HOME}/exports/${name}`));
  }
}

export function download(name, bytes) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([bytes]));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

// Whether this page may write the player's folder: one page at a time. `taken` is called when another page takes over.
export function takeTurn(taken, { byForce = false } = {}) {
  if (!navigator.locks) return Promise.resolve(true);
  return new Promise((answer) => {
    navigator.locks
      .request("ninja-game player", byForce ? { steal: true } : { ifAvailable: true }, (lock) => {
        answer(lock !== null);
        return lock && new Promise(() => {}); // held until the page closes
      })
      .catch(taken);
  });
}
