// The programs under test: started with their own folder, ended with the test.
import {spawn} from 'node:child_process';
import {once} from 'node:events';
import {createInterface} from 'node:readline';
import {mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

export class Folder {
  constructor() { this.path = mkdtempSync(join(tmpdir(), 'trivela_page_')); }
  file(name) { return join(this.path, name); }
  remove() { rmSync(this.path, {recursive: true, force: true}); }
}

export class Trivela {
  constructor(folder, ...args) {
    this.process = spawn(process.env.TRIVELA, args, {cwd: folder.path, stdio: ['ignore', 'pipe', 'pipe']});
    this.lines = createInterface({input: this.process.stdout});
    this.errors = '';
    this.process.stderr.on('data', (data) => { this.errors += data; });
    this.ended = once(this.process, 'exit');
    this.firstLine = Promise.race([once(this.lines, 'line').then(([line]) => line),
      this.ended.then(([code]) => { throw new Error(`trivela ${args.join(' ')} ended with ${code}: ${this.errors}`); })]);
    this.firstLine.catch(() => {});
  }
  kill(signal) { this.process.kill(signal); }
  // Its exit code, or the signal that ended it.
  async end() {
    const [code, signal] = await this.ended;
    return code ?? signal;
  }
  stop() {
    if (this.process.exitCode === null && this.process.signalCode === null) this.process.kill('SIGKILL');
  }
}
