# Reads reports of the thread sanitizer: prints the findings, then how many reports there were; exit 1
# where something was found.
#
# A race counts as Cyclone's own where both accesses are made by libddsc.so itself: Debian's is not instrumented, so that
# its atomics are unseen, and what they order (buffers that one of its threads received and another copies or frees,
# mutexes that it destroys with what they guard) looks unordered. The sanitizer's own suppressions do not know that
# much: "race:libddsc.so" holds for every stack with a frame of the library, which is every listener of ours, and
# "called_from_lib:libddsc.so" forgets the library's mutexes too, so that all that crosses the bus looks like a race.

function end_report() {
  if (report == "") return
  if (race && accesses == 2 && of_library == 2) {
    library++
  } else {
    found++
    printf "%s", report
  }
  report = ""
}

/(WARNING|ERROR): ThreadSanitizer: / {
  end_report()
  race = /data race/
  accesses = of_library = seeking = 0
  report = "\n"
}
report == "" { next }
{ report = report $0 "\n" }
/^  (Previous )?([Aa]tomic )?([Rr]ead|[Ww]rite) of size / { accesses++; seeking = 1; next }
seeking && /^    #/ && !/\(libtsan\.so[^ ]*\)$/ {  # the first frame that is not the sanitizer's
  if (/\(libddsc\.so[^ ]*\)$/) of_library++
  seeking = 0
}
/^$/ { seeking = 0 }
/^SUMMARY: / { end_report() }

END {
  end_report()
  printf "%d races of ours, %d of Cyclone's own left out\n", found, library
  exit found > 0
}
