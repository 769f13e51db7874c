import { Alerts } from './Alerts';
import { Bar } from './Bar';
import { DropTarget } from './DropTarget';
import { Header } from './Header';
import { Panel } from './Panel';
import { Stage } from './Stage';
import { Tabs } from './Tabs';
import { technique } from '../state/store';

export function App() {
  return (
    <div class="app">
      <Tabs />
      <main>
        <div id="work" class="work" role="tabpanel" aria-labelledby={`tab-${technique.value}`}>
          <Header />
          <div class="stage-frame">
            <Stage />
            <Alerts />
          </div>
          <Bar />
        </div>
      </main>
      <Panel />
      <DropTarget />
    </div>
  );
}
