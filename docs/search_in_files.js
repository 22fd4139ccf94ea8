// Lets the search work where pages are opened as files: browsers start no worker there, so the
// worker's script runs in a hidden frame that takes and sends the same messages.
(function () {
  if (location.protocol !== "file:") return;

  class IFrameWorker extends EventTarget {
    constructor(url) {
      super();
      this.onmessage = null;
      this.onerror = null;
      this.frame = document.createElement("iframe");
      this.frame.hidden = true;
      document.body.appendChild(this.frame);
      this.waiting = [];
      this.receive = (event) => {
        if (event.source !== this.frame.contentWindow) return;
        this.dispatchEvent(new MessageEvent("message", { data: event.data }));
        if (this.onmessage) this.onmessage(event);
      };
      window.addEventListener("message", this.receive);
      this.frame.ready = () => {
        const waiting = this.waiting;
        this.waiting = null;
        for (const message of waiting) this.postMessage(message);
      };
      const inside = this.frame.contentWindow.document;
      inside.open();
      inside.write(
        "<!doctype html><html><body><script>" +
          "postMessage = (message) => parent.postMessage(message, '*');" +
          "importScripts = (...urls) => urls.reduce((before, url) => before.then(() =>" +
          " new Promise((done, failed) => { const s = document.createElement('script');" +
          " s.src = url; s.onload = done; s.onerror = failed; document.body.append(s); }))," +
          " Promise.resolve());" +
          "<\/script><script src='" + new URL(url, location.href) + "'><\/script>" +
          "<script>frameElement.ready();<\/script></body></html>"
      );
      inside.close();
    }

    postMessage(message) {
      if (this.waiting) this.waiting.push(message);
      else this.frame.contentWindow.dispatchEvent(
        new MessageEvent("message", { data: message, source: window })
      );
    }

    terminate() {
      window.removeEventListener("message", this.receive);
      this.frame.remove();
    }
  }

  window.IFrameWorker = IFrameWorker;
  window.Worker = IFrameWorker;
})();
