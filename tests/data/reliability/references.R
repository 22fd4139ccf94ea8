# Makes references.json: R's own answers to what tests/scoring/test_scoring_reliability.py asks.
#     Rscript tests/data/reliability/references.R > tests/data/reliability/references.json
# Debian: r-cran-psych, r-cran-lme4, r-cran-jsonlite. The tests read the JSON and need no R.
suppressMessages({library(psych); library(lme4); library(jsonlite)})
set.seed(29)

icc <- function(x, source) {
  r <- suppressWarnings(ICC(x, lmer = FALSE))$results
  list(source = source, points = unname(as.matrix(x)), value = unname(r$ICC),
       lower = unname(r[["lower bound"]]), upper = unname(r[["upper bound"]]))
}
fit <- function(d, formula) {
  m <- lmer(formula, data = d, REML = TRUE, control = lmerControl(optimizer = "bobyqa",
    optCtrl = list(rhoend = 1e-10, maxfun = 1e5), calc.derivs = FALSE,
    check.conv.singular = "ignore"))
  v <- as.data.frame(VarCorr(m))
  setNames(as.list(v$vcov), sub("Residual", "residual", v$grp))
}
whole <- y ~ 1 + (1 | s) + (1 | e) + (1 | o) + (1 | s:e) + (1 | s:o) + (1 | e:o)
cube <- function(n, m, k, sd) {
  d <- expand.grid(o = 1:k, e = 1:m, s = 1:n)
  u <- function(groups, s) { l <- unique(groups); rnorm(length(l), 0, s)[match(groups, l)] }
  d$y <- round(60 + u(d$s, sd[1]) + u(d$e, sd[2]) + u(d$o, sd[3]) + u(paste(d$s, d$e), sd[4]) +
    u(paste(d$s, d$o), sd[5]) + u(paste(d$e, d$o), sd[6]) + rnorm(nrow(d), 0, sd[7]), 1)
  for (f in c("s", "e", "o")) d[[f]] <- factor(d[[f]])
  d
}
tabled <- function(d, source, formula) {
  list(source = source, cells = unname(data.matrix(d[c("s", "e", "o")])) - 1, points = d$y,
       variances = fit(d, formula))
}
# expected mean squares of a complete three-way table, from R's own analysis of variance
squares <- function(d) {
  t <- anova(lm(y ~ s * e * o, data = d)); ms <- setNames(t[["Mean Sq"]], rownames(t))
  n <- nlevels(d$s); m <- nlevels(d$e); k <- nlevels(d$o); r <- ms[["s:e:o"]]
  list(source = "simulated", cells = unname(data.matrix(d[c("s", "e", "o")])) - 1, points = d$y,
    variances = list(
      residual = r, "s:e" = (ms[["s:e"]] - r) / k, "s:o" = (ms[["s:o"]] - r) / m,
      "e:o" = (ms[["e:o"]] - r) / n,
      s = (ms[["s"]] - ms[["s:e"]] - ms[["s:o"]] + r) / (m * k),
      e = (ms[["e"]] - ms[["s:e"]] - ms[["e:o"]] + r) / (n * k),
      o = (ms[["o"]] - ms[["s:o"]] - ms[["e:o"]] + r) / (n * m)))
}

shrout <- matrix(c(9,2,5,8, 6,1,3,2, 8,4,6,8, 7,1,2,6, 10,5,6,9, 6,2,4,7), 6, byrow = TRUE)
skill <- rnorm(18, 0, 9)
marks <- round(62 + outer(skill, rep(1, 7)) + outer(rep(1, 18), c(-8, 4, 0, 12, -3, 6, -11)) +
  matrix(rnorm(126, 0, 8), 18), 1)
chance <- matrix(round(rnorm(40, 70, 6), 1), 10)
big <- cube(14, 6, 4, c(9, 6, 3, 5, 3, 2, 6))
gaps <- big[runif(nrow(big)) > 0.25, ]
few <- cube(12, 5, 3, c(7, 4, 0, 0, 3, 0, 8)); few <- few[runif(nrow(few)) > 0.3, ]
pair <- cube(20, 8, 1, c(8, 5, 0, 0, 0, 0, 7)); pair <- pair[runif(nrow(pair)) > 0.2, ]
pen <- data.frame(s = Penicillin$plate, e = Penicillin$sample, o = factor(1), y = Penicillin$diameter)
rating <- c(1,1,2,2,2,2,3,3,3,3,3,4,4,4,5,5)
score <- c(31.5,44,52,48.5,61,39.5,66,71.5,58,63,75,78,84.5,69,91,88)
line <- lm(score ~ rating)
at <- predict(line, data.frame(rating = c(2, 2.5)), se.fit = TRUE)
weighed <- suppressWarnings(alpha(attitude, check.keys = FALSE))
one <- data.frame(y = c(55,61,58, 72,70, 44,51,47,50, 88, 63,66), who = factor(rep(1:5, c(3,2,4,1,2))))

cat(toJSON(list(
  made_with = list(R = R.version.string, psych = as.character(packageVersion("psych")),
                   lme4 = as.character(packageVersion("lme4"))),
  icc = list(icc(shrout, "Shrout and Fleiss 1979, table 2"),
             icc(as.matrix(attitude), "R's data set attitude (Chatterjee and Price)"),
             icc(marks, "simulated: 18 students, 7 exercises"),
             icc(chance, "simulated: chance alone")),
  closed = list(squares(droplevels(big))),
  reml = list(tabled(droplevels(gaps), "simulated, a quarter of the cells missing", whole),
              tabled(droplevels(few), "simulated, components of 0, 30 % missing", whole),
              tabled(droplevels(pair), "simulated, once each, 20 % missing", y ~ 1 + (1|s) + (1|e)),
              tabled(pen, "Penicillin of lme4 (Davies and Goldsmith 1972)", y ~ 1 + (1|s) + (1|e))),
  items = list(source = "attitude", points = unname(as.matrix(attitude)),
               difficulty = unname(colMeans(attitude)) / 100,
               discrimination = unname(weighed$item.stats$r.drop)),
  within = list(points = split(one$y, one$who), sd = sigma(lm(y ~ who, data = one)),
                freedom = df.residual(lm(y ~ who, data = one))),
  borderline = list(rating = rating, score = score, at = c(2, 2.5), mark = unname(at$fit),
                    se = unname(at$se.fit))
), digits = NA, auto_unbox = TRUE, dataframe = "rows"))
cat("\n")
