# Competence by LC-CUSUM and CUSUM, computed by R alone: the references of tests/scoring.
#
# It shares no code with the program and is written from the papers: weights from the ratio of the
# binomial likelihoods (dbinom), scores by Reduce, probabilities twice - by running through all 2^n
# series of passes and failures, and by carrying the distribution of the score from attempt to attempt.
# Average run lengths come from the R package surveillance (Hoehle), which knows nothing of this
# program.
#
#   Rscript tests/scoring/references/competence.R > tests/scoring/references/competence_r.json
#
# Biau et al. 2008 (doi 10.1002/bjs.6056), Biau and Porcher 2010 (doi 10.1002/sim.3947),
# Page 1954, Hawkins 1992 (arlCusum).
suppressPackageStartupMessages({
  library(jsonlite)
  library(surveillance)
})

weight <- function(failed, null, alternative)
  dbinom(failed, 1, alternative, log = TRUE) - dbinom(failed, 1, null, log = TRUE)

scores <- function(failed, null, alternative)
  Reduce(function(s, x) max(0, s + weight(x, null, alternative)), failed, 0, accumulate = TRUE)[-1]

# P(signal within n) by all series of n attempts.
by_enumeration <- function(null, alternative, h, rate, n) {
  total <- 0
  for (code in 0:(2^n - 1)) {
    failed <- as.integer(intToBits(code))[1:n]
    if (any(scores(failed, null, alternative) >= h))
      total <- total + prod(dbinom(failed, 1, rate))
  }
  total
}

# P(signal within 1..n): a named vector holds the distribution of the score.
by_distribution <- function(null, alternative, h, rate, n, start = 0) {
  w <- weight(0:1, null, alternative)
  chance <- c(1 - rate, rate)
  p <- setNames(1, format(start, digits = 15))
  signalled <- numeric(n)
  done <- 0
  for (t in 1:n) {
    s <- as.numeric(names(p))
    to <- c(pmax(0, s + w[1]), pmax(0, s + w[2]))
    q <- c(p * chance[1], p * chance[2])
    done <- done + sum(q[to >= h])
    on <- to < h
    p <- tapply(q[on], formatC(to[on], digits = 10, format = "f"), sum)
    signalled[t] <- done
  }
  signalled
}

# Lowest limit of a grid of hundredths with at most alpha signals within n; here none is below 2.
limit <- function(null, alternative, rate, n, alpha)
  Find(function(h) tail(by_distribution(null, alternative, h, rate, n), 1) <= alpha,
       seq(2, 12, by = 0.01))

set.seed(20260801)
traces <- lapply(list(c(0.1, 0.4), c(0.1, 0.2), c(0.2, 0.5), c(0.03, 0.1)), function(r) {
  failed <- rbinom(60, 1, seq(0.6, 0.05, length.out = 60))
  list(acceptable = r[1], unacceptable = r[2], failed = failed,
       learning = scores(failed, r[2], r[1]), watching = scores(failed, r[1], r[2]))
})

short <- do.call(rbind, lapply(list(c(0.1, 0.4, 2), c(0.2, 0.5, 1.25), c(0.3, 0.7, 1.6)), function(r)
  data.frame(acceptable = r[1], unacceptable = r[2], limit = r[3], attempts = 12,
             alpha = by_enumeration(r[2], r[1], r[3], r[2], 12),
             missed = 1 - by_enumeration(r[2], r[1], r[3], r[1], 12),
             false_relapse = by_enumeration(r[1], r[2], r[3], r[1], 12))))

long <- lapply(list(c(0.1, 0.4, 3.89, 24), c(0.1, 0.2, 3.89, 116), c(0.1, 0.3, 4.09, 49),
                    c(0.2, 0.5, 3.81, 29), c(0.05, 0.15, 4.23, 115)), function(r)
  list(acceptable = r[1], unacceptable = r[2], limit = r[3],
       incompetent = by_distribution(r[2], r[1], r[3], r[2], r[4]),
       competent = by_distribution(r[2], r[1], r[3], r[1], r[4]),
       halfway = by_distribution(r[1], r[2], r[3], r[1], r[4], start = r[3] / 2)))

limits <- do.call(rbind, lapply(list(c(0.1, 0.4, 24, 0.05), c(0.1, 0.3, 49, 0.05),
                                     c(0.2, 0.5, 29, 0.05), c(0.1, 0.4, 50, 0.02)), function(r)
  data.frame(acceptable = r[1], unacceptable = r[2], attempts = r[3], alpha = r[4],
             learning = limit(r[2], r[1], r[2], r[3], r[4]),
             watching = limit(r[1], r[2], r[1], r[3], r[4]))))

# surveillance: a failure adds 1 - k, a pass takes k away, the signal comes at h or more; k and h are
# decimals, so that its Markov chain rounds nothing.
arls <- do.call(rbind, lapply(list(c(0.1, 2.5, 0.02), c(0.1, 2.5, 0.1), c(0.2, 3.4, 0.1),
                                   c(0.2, 3.4, 0.3), c(0.3, 4.1, 0.2), c(0.3, 4.1, 0.45)),
  function(r) data.frame(k = r[1], h = r[2], rate = r[3],
    arl = arlCusum(h = r[2], k = r[1], theta = r[3], distr = "binomial", digits = 1)$ARL)))

cat(toJSON(list(
  r = R.version.string, surveillance = as.character(packageVersion("surveillance")),
  traces = traces, enumerated = short, distributions = long, limits = limits,
  surveillance_arl = arls),
  digits = 15, auto_unbox = TRUE, pretty = FALSE))
