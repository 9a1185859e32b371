"""The tables of the records, in the steps by which they came to be (`docs/player-data.md`)."""

MIGRATIONS = (
    """
    CREATE TABLE replay (
        id INTEGER PRIMARY KEY,
        level TEXT NOT NULL,          -- digest of the level
        level_text TEXT NOT NULL,     -- the level itself, exact
        name TEXT NOT NULL,
        player TEXT NOT NULL,
        body TEXT NOT NULL,
        outcome TEXT NOT NULL,
        final_tick INTEGER NOT NULL,
        gold INTEGER NOT NULL,
        score INTEGER NOT NULL,       -- ticks
        digest TEXT NOT NULL,         -- of the world after the final tick
        inputs BLOB NOT NULL,         -- one byte a tick
        made_at TEXT NOT NULL,        -- UTC, ISO 8601
        kept INTEGER NOT NULL         -- the player asked for it
    );
    CREATE VIEW saved_replay AS
        SELECT id, level, name, player, body, outcome, final_tick, gold, score, made_at, kept FROM replay;
    CREATE TABLE level_best (
        level TEXT NOT NULL, body TEXT NOT NULL,
        replay INTEGER NOT NULL REFERENCES replay (id),
        PRIMARY KEY (level, body)
    ) WITHOUT ROWID;
    CREATE TABLE episode_best (
        episode TEXT NOT NULL,        -- digest of its levels
        body TEXT NOT NULL,
        score INTEGER NOT NULL,
        replays TEXT NOT NULL,        -- ids with blanks between, in the order of its levels
        made_at TEXT NOT NULL,
        PRIMARY KEY (episode, body)
    ) WITHOUT ROWID;
    CREATE TABLE progress (
        grid_column INTEGER PRIMARY KEY,
        reached_episode INTEGER NOT NULL, reached_level INTEGER NOT NULL,
        beaten_episode INTEGER NOT NULL, beaten_level INTEGER NOT NULL
    );
    CREATE TABLE death (killer TEXT PRIMARY KEY, times INTEGER NOT NULL) WITHOUT ROWID;
    """,
    """
    CREATE TABLE played (
        level TEXT PRIMARY KEY,
        attempts INTEGER NOT NULL, passes INTEGER NOT NULL, deaths INTEGER NOT NULL,
        ticks INTEGER NOT NULL, gold INTEGER NOT NULL
    ) WITHOUT ROWID;
    CREATE TABLE fact (name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
    """,
    # The digest of a replay became one of what the world shows; the older ones mean nothing any more.
    "UPDATE replay SET digest = '';",
    # An episode's replays get a table of their own; replays say whether they were made in practice.
    """
    ALTER TABLE replay ADD COLUMN practice INTEGER NOT NULL DEFAULT 0;
    CREATE TABLE episode_replay (
        episode TEXT NOT NULL, body TEXT NOT NULL,
        place INTEGER NOT NULL,       -- of its level in the episode, from 0
        replay INTEGER NOT NULL REFERENCES replay (id),
        PRIMARY KEY (episode, body, place)
    ) WITHOUT ROWID;
    INSERT INTO episode_replay (episode, body, place, replay)
        SELECT best.episode, best.body, id.key, replay.id
        FROM (SELECT episode, body, '[' || replace(trim(replays), ' ', ',') || ']' AS ids FROM episode_best) AS best
        JOIN json_each(CASE WHEN json_valid(best.ids) THEN best.ids ELSE '[]' END) AS id
        JOIN replay ON replay.id = id.value;
    CREATE TABLE new_best (
        episode TEXT NOT NULL,        -- digest of its levels
        body TEXT NOT NULL,
        score INTEGER NOT NULL,
        made_at TEXT NOT NULL,
        PRIMARY KEY (episode, body)
    ) WITHOUT ROWID;
    INSERT INTO new_best (episode, body, score, made_at) SELECT episode, body, score, made_at FROM episode_best;
    DROP TABLE episode_best;
    ALTER TABLE new_best RENAME TO episode_best;
    DROP VIEW saved_replay;
    """,
    # The fastest and the richest run of each level, from the runs that are here; progress in other packs.
    """
    CREATE TABLE level_mark (
        level TEXT NOT NULL, body TEXT NOT NULL,
        fastest INTEGER NOT NULL,     -- tick of the earliest exit contact
        most_gold INTEGER NOT NULL,   -- pieces in the passed run that took the most
        PRIMARY KEY (level, body)
    ) WITHOUT ROWID;
    INSERT INTO level_mark (level, body, fastest, most_gold)
        SELECT level, body, min(final_tick), max(gold) FROM replay
        WHERE outcome = 'exit' AND practice = 0 GROUP BY level, body;
    CREATE TABLE new_progress (
        pack TEXT NOT NULL,           -- its name; '' for the game's own
        grid_column INTEGER NOT NULL,
        reached_episode INTEGER NOT NULL, reached_level INTEGER NOT NULL,
        beaten_episode INTEGER NOT NULL, beaten_level INTEGER NOT NULL,
        PRIMARY KEY (pack, grid_column)
    ) WITHOUT ROWID;
    INSERT INTO new_progress SELECT '', grid_column, reached_episode, reached_level, beaten_episode, beaten_level
        FROM progress;
    DROP TABLE progress;
    ALTER TABLE new_progress RENAME TO progress;
    """,
)
"""Each brings a file from the version of its index to the next; they are never edited once released."""

VERSION = len(MIGRATIONS)

TABLES = {"replay", "level_best", "level_mark", "episode_best", "episode_replay", "progress", "death", "played", "fact"}
"""All tables of the newest version."""
