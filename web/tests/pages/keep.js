importScripts("/package/src/service_worker.js");
keepFbsPlayer("/package/src/");
