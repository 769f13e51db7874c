import { TriangleAlert, X } from 'lucide-preact';
import { alerts, clearAlerts } from '../state/store';

/** What went wrong and what to do about it, over the stage's foot; the stage keeps what it shows. */
export function Alerts() {
  if (alerts.value.length === 0) return null;
  return (
    <div class="alert" role="alert">
      <TriangleAlert size={20} aria-hidden />
      <div>
        {alerts.value.map((message) => (
          <p key={message}>{message}</p>
        ))}
      </div>
      <button type="button" class="tool" aria-label="Dismiss" title="Dismiss" onClick={clearAlerts}>
        <X size={18} aria-hidden />
      </button>
    </div>
  );
}
