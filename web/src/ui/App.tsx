import { Alerts } from './Alerts';
import { Bar } from './Bar';
import { DropTarget } from './DropTarget';
import { FieldView } from './FieldView';
import { HalfSwitch } from './HalfSwitch';
import { Header } from './Header';
import { Panel } from './Panel';
import { Stage } from './Stage';
import { Statistics } from './Statistics';
import { Tabs } from './Tabs';
import { WoodView } from './WoodView';
import { half } from '../state/pebbles';
import { entry, technique } from '../state/store';

export function App() {
  const { solid, panels, measurable } = entry.value;
  const halves = solid || panels !== undefined;
  return (
    <div class="app">
      <Tabs />
      <main>
        <div id="work" class="work" role="tabpanel" aria-labelledby={`tab-${technique.value}`}>
          <Header />
          <div class="stage-frame" data-halves={halves} data-half={half.value}>
            <Stage />
            {solid && <FieldView />}
            {panels && <WoodView />}
            {halves && <HalfSwitch />}
            <Alerts />
          </div>
          {measurable && <Statistics />}
          <Bar />
        </div>
      </main>
      <Panel />
      <DropTarget />
    </div>
  );
}
