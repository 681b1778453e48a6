// Browsers give pages that are opened from disk no workers, and the search is one: here it runs in a hidden frame.
if (location.protocol === "file:") {
  window.Worker = class extends EventTarget {
    constructor(url) {
      super()
      const frame = document.body.appendChild(Object.assign(document.createElement("iframe"), { hidden: true }))
      this.inside = frame.contentWindow
      this.inside.postMessage = data => this.dispatchEvent(new MessageEvent("message", { data }))
      this.inside.importScripts = (...urls) => urls.reduce((before, each) => before.then(() => this.load(each)), Promise.resolve())
      this.ready = this.load(url)
    }

    load(url) {
      return new Promise((resolve, reject) => {
        const script = Object.assign(this.inside.document.createElement("script"), { src: url, onload: resolve, onerror: reject })
        this.inside.document.body.appendChild(script)
      })
    }

    postMessage(data) {
      this.ready = this.ready.then(() => { this.inside.dispatchEvent(new MessageEvent("message", { data })) })
    }

    terminate() {
      this.inside.frameElement.remove()
    }

    set onmessage(answer) {
      this.addEventListener("message", answer)
    }

    set onerror(answer) {
      this.addEventListener("error", answer)
    }
  }
}
