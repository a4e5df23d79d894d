import { useCallback, useEffect, useMemo, useState } from 'preact/hooks';
import { EngineError } from '../../engine/client';
import { OperandCard } from '../../operands/operand_card';
import { short } from '../../numbers/display';
import { Readouts, Section } from '../../shell/controls';
import type { Download, PageProps, Shell } from '../../shell/page';
import { Panel, Stage } from '../../shell/parts';
import { Results } from '../../shell/results';
import { useTheme } from '../../shell/theme';
import { appliedToBox } from '../../view2d/affine';
import { unionOf, type Box } from '../../view2d/camera';
import { PlaneView } from '../../view2d/plane_view';
import { SpacePicture } from '../../view3d/space_picture';
import type { Hit } from '../../view3d/view';
import { NestingOffer } from '../nesting/offer';
import { clearanceText, contactText, freeAnglesText } from './names';
import { PathSection } from './path_section';
import { PoseSection } from './pose_section';
import { configuration, type ObstacleFile } from './service';
import { kPatchColours, spaceOverlay } from './space';
import type { ObstacleState, Pose, Which } from './state';
import { pathText } from './path_file';
import { planePath, useObstacle, type ObstacleData } from './use_obstacle';
import { gripOf, paintWorkspace, placing, poseOf, posesBeside, type WorkspaceScene } from './workspace';
import './obstacle.css';

export const kSummary = 'A robot that moves and turns, and the obstacle that this makes in (x, y, θ), exactly. Drag the robot, its handle, its start and its goal.';

function useDownloads({ engine, setDownloads }: Shell, state: ObstacleState, tanHalf: string, data: ObstacleData): void {
  const { robot, obstacle } = state, { plan, scene } = data;
  useEffect(() => {
    const file = (label: string, extension: Exclude<ObstacleFile, 'path'>): Download => ({
      label, fileName: `obstacle.${extension}`, make: () => engine.ask('obstacleFile', { robot, obstacle, tanHalf, file: extension }),
    });
    const path: Download = { label: 'Path (JSON)', fileName: 'path.json', make: () => Promise.resolve(pathText(plan?.path ?? [])) };
    const found = plan && plan.path.length > 0 ? [path] : [];
    setDownloads(scene ? [file('Obstacle (GLB)', 'glb'), file('Obstacle, exact (.obstacle)', 'obstacle'), file('Slice (WKT)', 'wkt'), ...found] : []);
  }, [engine, setDownloads, robot, obstacle, tanHalf, plan, scene]);
}

function homeOf(data: ObstacleData, state: ObstacleState): Box | undefined {
  const { robot, obstacle } = data;
  if (!robot.outline || !obstacle.outline) return undefined;
  const boxes = [state.start, state.goal, state.at].map((pose) => appliedToBox(placing(configuration(pose)), robot.outline!.box));
  return unionOf([obstacle.outline.box, ...boxes]);
}

function wrongPlaces({ robot, obstacle }: ObstacleData): { x: number; y: number }[] {
  return [robot.error, obstacle.error].flatMap((error) => {
    const { x, y } = error instanceof EngineError ? error.evidence : {};
    return x !== undefined && y !== undefined ? [{ x, y }] : [];
  });
}

function Facts({ data, state, onPath }: { data: ObstacleData; state: ObstacleState; onPath: boolean }) {
  const { place, scene } = data, found = place?.clearance;
  const stands = found && (onPath ? `on the path, clearance ${short(Math.max(0, found.distance))}` : clearanceText(found, place.overlaps));
  return (
    <Section title="Clearance">
      <Results {...data.standing} refused={(data.robot.error ?? data.obstacle.error) !== undefined}>
        <Readouts
          rows={[
            ['The robot', stands],
            ['Nearest contact', found?.contact ? contactText(found.contact) : undefined],
            ['Free angles here', place && freeAnglesText(place.freeAngles)],
            ['Patches, shells', scene && `${scene.patches}, ${scene.shells}`],
            ['Free space', scene && `${scene.components} ${scene.components === 1 ? 'component' : 'components'}`],
            ['Events', scene && `${scene.events} at ${scene.angles.length} angles`],
            ['Computed in', scene && `${short(Math.round(10 * scene.ms) / 10)} ms`],
          ]}
        />
      </Results>
      <div class="legend">
        <span style={{ color: `var(${kPatchColours[0]})` }}>■</span> an edge of the obstacle on a vertex of the robot
        <br />
        <span style={{ color: `var(${kPatchColours[1]})` }}>■</span> an edge of the robot on a vertex of the obstacle
        {state.strict ? '' : '; touching is free'}
      </div>
    </Section>
  );
}

export function View({ state, change, shell }: PageProps<ObstacleState>) {
  const [share, setShare] = useState<number | undefined>();
  const [playing, setPlaying] = useState(false);
  const [hovered, setHovered] = useState('');
  const theme = useTheme();
  const [motion, setMotion] = useState<ObstacleData['motion']>();
  const onPath = motion && share !== undefined;
  const now = useMemo(() => (onPath ? motion.at(share) : configuration(state.at)), [onPath, motion, share, state.at]);
  const pose = useMemo(() => (onPath ? poseOf(now) : state.at), [onPath, now, state.at]);
  const data = useObstacle(shell, state, pose), { robot, space, place, slice } = data;
  useEffect(() => {
    setMotion(data.motion);
    setShare(undefined);
  }, [data.motion]);
  useDownloads(shell, state, pose.tanHalf, data);
  useEffect(() => {
    const box = data.obstacle.outline?.box;
    if (!state.unplaced || !robot.ready || !data.obstacle.ready || !robot.outline || !box) return;
    const placed = { ...state, ...posesBeside(robot.outline, box) };
    delete placed.unplaced;
    change({ ...placed, at: { ...placed.start, tanHalf: state.at.tanHalf } }, 'aside'); // at the angle that was asked for
  }, [state, change, robot, data.obstacle]);
  const move = useCallback((which: Which, to: Pose, how?: 'live' | 'done') => {
    if (which === 'at') setShare(undefined);
    change({ ...state, [which]: to }, how);
  }, [state, change]);
  const path = useMemo(() => planePath(data.motion), [data.motion]);
  const clearance = place?.clearance;
  const workspace: WorkspaceScene = { robot: robot.outline, obstacle: data.obstacle.outline, now, state, path, clearance, overlaps: !onPath && place?.overlaps === true, wrong: wrongPlaces(data) };
  const start = configuration(state.start), goal = configuration(state.goal);
  const overlay = useMemo(
    () => (space ? spaceOverlay(space, { now, slice, clearance, motion: data.motion, start, goal }) : {}),
    [space, now, slice, clearance, data.motion, start.x, start.y, start.theta, goal.x, goal.y, goal.theta, theme], // eslint-disable-line react-hooks/exhaustive-deps -- poses by their numbers; colours are the theme's
  );
  const hover = (hit: Hit | undefined): void => {
    const { scene } = data;
    if (!hit || !scene) return setHovered('');
    const [kind, p, q] = scene.contacts.subarray(3 * scene.patchOf[hit.triangle]!);
    setHovered(contactText({ kind: kind === 0 ? 'edge_of_p' : 'edge_of_q', p: p!, q: q! }));
  };
  const home = useMemo(() => homeOf(data, state), [robot.outline, data.obstacle.outline, state.unplaced]); // eslint-disable-line react-hooks/exhaustive-deps -- the picture does not follow drags
  const cut = state.cut && space ? space.placement.height(now.theta) + 1e-6 : undefined;
  return (
    <>
      <Stage>
        <div class="pair">
          <div>
            <PlaneView
              label={`Robot ${state.robot.name} among ${state.obstacle.name}: ${clearance ? clearanceText(clearance, place.overlaps) : 'not known yet'}`}
              home={home} homeKey={`${robot.of?.name} ${data.obstacle.of?.name} ${state.unplaced === true}`} paint={(painter) => paintWorkspace(painter, workspace)}
              grip={(at, reach) => robot.outline && gripOf(robot.outline, { ...state, at: pose }, at, reach, move)}
            />
            <div class={data.standing.waiting ? 'status stale' : 'status'}>{clearance && clearanceText(clearance, workspace.overlaps)}</div>
          </div>
          <div>
            <SpacePicture
              label={`The obstacle in x, y and θ: ${data.scene ? `${data.scene.patches} patches` : 'not known yet'}`}
              shape={space?.surface} colours={kPatchColours} opacity={state.through ? 0.42 : 1} cut={cut} overlay={overlay} onHover={hover} stale={data.standing.waiting}
            >
              <span class="caption">x, y; θ upwards</span>
              <div class="status">{hovered}</div>
            </SpacePicture>
          </div>
        </div>
      </Stage>
      <Panel summary={kSummary}>
        <Section title="Shapes">
          <OperandCard shell={shell} role="Robot" tint="q" shape={state.robot} operand={robot} onShape={(shape) => change({ ...state, robot: shape })} />
          <OperandCard shell={shell} role="Obstacle" tint="p" shape={state.obstacle} operand={data.obstacle} onShape={(shape) => change({ ...state, obstacle: shape })} />
          <NestingOffer shape={state.obstacle} error={data.obstacle.error} shell={shell} />
        </Section>
        <PoseSection state={state} change={change} scene={data.scene} pose={pose} move={(to, how) => move('at', to, how)} />
        <Facts data={data} state={state} onPath={onPath === true} />
        <PathSection state={state} change={change} data={data} share={share} setShare={setShare} playing={playing} setPlaying={setPlaying} />
      </Panel>
    </>
  );
}
