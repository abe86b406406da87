// The common part of path painters: chooses the level, the part of it in view, and the part that is done.
import { boxSight } from "./camera";
import { chooseLevel, pointsUpTo, type Level, type Run } from "./levels";
import type { Colour, PathColours, PathPainter, Picture } from "./painter";
import type { Path } from "./path_points";

export abstract class LevelledPainter implements PathPainter {
  protected path: Path | undefined;
  private levels: readonly Level[] = [];
  private drawn: { level: Level; runs: Run[]; done: number } | undefined;

  show(path: Path, levels: readonly Level[]): void {
    this.path = path;
    this.levels = levels;
    this.drawn = undefined;
  }

  draw(picture: Picture, colours: PathColours): void {
    this.prepare(picture);
    this.clear(picture);
    if (this.path === undefined || this.path.line.length < 2) return;
    const { camera, view } = picture;
    const { level, runs } = chooseLevel(this.levels, camera.mm_per_pixel, picture.most_points, boxSight(camera, view));
    const done = this.doneOf(level, picture);
    this.paintRuns(level, runs, done, Infinity, colours.ahead, colours.rapid);
    this.paintRuns(level, runs, 0, done, colours.done, colours.done);
    this.drawn = { level, runs, done };
  }

  advance(picture: Picture, colours: PathColours): void {
    const before = this.drawn;
    if (before === undefined) return;
    const done = this.doneOf(before.level, picture);
    if (done < before.done) return this.draw(picture, colours);
    if (done === before.done) return;
    this.prepare(picture);
    this.paintRuns(before.level, before.runs, before.done, done, colours.done, colours.done);
    this.drawn = { ...before, done };
  }

  drawnTo(): number {
    return this.drawn?.level.points[this.drawn.done] ?? 0;
  }

  protected abstract prepare(picture: Picture): void;
  protected abstract clear(picture: Picture): void;
  /** Paints the segments between points `first` and `last` of a level. */
  protected abstract paint(level: Level, first: number, last: number, cut: Colour, rapid: Colour): void;

  private doneOf(level: Level, { reached }: Picture): number {
    return Math.max(0, pointsUpTo(level, reached - 1) - 1);
  }

  private paintRuns(level: Level, runs: readonly Run[], first: number, last: number, cut: Colour, rapid: Colour): void {
    for (const run of runs) {
      const [from, to] = [Math.max(run.first, first), Math.min(run.last, last)];
      if (from < to) this.paint(level, from, to, cut, rapid);
    }
  }
}
